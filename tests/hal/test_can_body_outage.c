/* After an outage: of all that queued up meanwhile, the newest senses count. */
#include "fake_body.h"

#include "wire_frames.h"

static void test_after_an_outage_the_last_senses_count_whatever_their_number(void)
{
    static const unsigned ticks[] = {1500, 1501, 1502, 0, 1, 2};

    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned i = 0; i < 6; i++)
        senses_come(150, ticks[i]);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT8(2, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 5});
}

static void test_after_an_outage_only_the_newest_senses_count(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned tick = 0; tick < 30; tick++)
        senses_come(150, tick);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(29, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 29});
}

static void test_noise_among_what_queued_up_is_passed_over(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    noise_comes(150);
    happens(150, LINK_E_GARBLED, (struct frame){.len = 0});
    senses_come(150, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 1, .foreign = 1, .damaged = 1});
}

static void test_another_robots_memory_that_queued_up_is_passed_over(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    happens(150, 1, memory_frame(NODE + 1, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.stale = 0});
}

static void test_without_an_outage_nothing_is_passed_over(void)
{
    for (unsigned tick = 0; tick < 30; tick++)
        senses_come(20, tick);
    for (unsigned tick = 0; tick < 30; tick++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT16(tick, in.senses.tick);
    }
}

static void test_after_an_outage_a_queued_command_comes_first(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    command_comes(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    senses_come(150, 1);
    senses_come(150, 2);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(2, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 2});
}

static void test_senses_that_a_queued_command_outdates_do_not_end_the_outage(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    command_comes(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(200, fake.clock_ms);
}

static void test_a_body_opened_again_has_no_outage(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL(0, open_body());
    senses_come(150, 0);
    senses_come(150, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(0, in.senses.tick);
}

static void test_an_outage_ends_with_its_first_senses(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    senses_come(170, 1);
    senses_come(170, 2);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
}

static void test_a_robot_that_was_held_up_itself_takes_the_newest_senses(void)
{
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    for (unsigned tick = 1; tick <= 7; tick++)
        senses_come(20u * tick, tick);
    fake.clock_ms += 150;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(7, in.senses.tick);
    assert_faults((struct octet_faults_t){.silences = 1, .stale = 6});
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_after_an_outage_the_last_senses_count_whatever_their_number);
    RUN_TEST(test_after_an_outage_only_the_newest_senses_count);
    RUN_TEST(test_noise_among_what_queued_up_is_passed_over);
    RUN_TEST(test_another_robots_memory_that_queued_up_is_passed_over);
    RUN_TEST(test_without_an_outage_nothing_is_passed_over);
    RUN_TEST(test_after_an_outage_a_queued_command_comes_first);
    RUN_TEST(test_senses_that_a_queued_command_outdates_do_not_end_the_outage);
    RUN_TEST(test_a_body_opened_again_has_no_outage);
    RUN_TEST(test_an_outage_ends_with_its_first_senses);
    RUN_TEST(test_a_robot_that_was_held_up_itself_takes_the_newest_senses);
    return UNITY_END();
}
