/* After an outage: of all that queued up meanwhile, the newest senses count. */
#include "fake_body.h"

#include "tests/hal/protocol/wire_frames.h"

TEST(after_an_outage_the_last_senses_count_whatever_their_number)
{
    static const unsigned ticks[] = {1500, 1501, 1502, 0, 1, 2};

    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned i = 0; i < 6; i++)
        senses_come(150, ticks[i]);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT8(2, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 5});
}

TEST(after_an_outage_only_the_newest_senses_count)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned tick = 0; tick < 30; tick++)
        senses_come(150, tick);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(29, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 29});
}

TEST(noise_among_what_queued_up_is_passed_over)
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

TEST(another_robots_memory_that_queued_up_is_passed_over)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    happens(150, 1, memory_frame(NODE + 1, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.stale = 0});
}

TEST(without_an_outage_nothing_is_passed_over)
{
    for (unsigned tick = 0; tick < 30; tick++)
        senses_come(20, tick);
    for (unsigned tick = 0; tick < 30; tick++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT16(tick, in.senses.tick);
    }
}

TEST(after_an_outage_a_queued_command_comes_first)
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

TEST(senses_that_a_queued_command_outdates_do_not_end_the_outage)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    command_comes(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(200, fake.clock_ms);
}

TEST(a_body_opened_again_has_no_outage)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL(0, open_body());
    senses_come(150, 0);
    senses_come(150, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(0, in.senses.tick);
}

TEST(an_outage_ends_with_its_first_senses)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    senses_come(170, 1);
    senses_come(170, 2);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
}

TEST(a_robot_that_was_held_up_itself_takes_the_newest_senses)
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
