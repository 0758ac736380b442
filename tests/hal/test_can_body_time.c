/* When silence begins, to the millisecond, and what waits when it has ended. */
#include "fake_body.h"

#include "wire_frames.h"

enum { LOOKS_MAX = 4096 };   /* at the link, for the newest senses */

static void test_silence_counts_from_the_last_senses_whatever_else_comes(void)
{
    senses_come(50, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    noise_comes(90);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(150, fake.clock_ms);
}

static void test_held_up_for_the_limit_it_takes_the_newest_senses(void)
{
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    for (unsigned tick = 1; tick <= 5; tick++)
        senses_come(20u * tick, tick);
    fake.clock_ms += HAL_SILENCE_MS;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(5, in.senses.tick);
}

static void test_held_up_for_less_it_takes_the_next_senses(void)
{
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    for (unsigned tick = 1; tick <= 5; tick++)
        senses_come(19u * tick, tick);
    fake.clock_ms += HAL_SILENCE_MS - 1;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
}

static void test_held_up_for_longer_with_nothing_of_use_it_reports_silence_at_once(void)
{
    noise_comes(10);
    fake.clock_ms += 150;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(150, fake.clock_ms);
}

static void test_looking_for_the_newest_senses_takes_no_time_and_no_look_too_many(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    senses_come(150, 1);
    fake.receives = 0;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(3, fake.receives);   /* one finds nothing more */
    TEST_ASSERT_EQUAL_UINT32(150, fake.clock_ms);
}

static void test_of_senses_without_end_so_many_are_looked_at(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    fake.endless = true;
    fake.receives = 0;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(1 + LOOKS_MAX, fake.receives);
}

static void test_opened_again_it_has_heard_of_no_silence(void)
{
    fake.clock_ms += 150;
    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, receive());
    fake.closed = false;
    TEST_ASSERT_EQUAL(0, open_body());
    senses_come(170, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
}

static enum input_kind owner_starts(uint32_t at_ms, uint8_t owner)
{
    const struct output answer = {.has_answer = true};

    command_comes(at_ms, (struct octet_command_t){.opcode = OPCODE_START, .counter = 1, .owner = owner, .lockstep = 1});
    if (receive() != INPUT_COMMAND)
        return INPUT_SILENCE;
    TEST_ASSERT_EQUAL(0, hal_send(hal, &answer));
    return INPUT_COMMAND;
}

static void silences(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
}

static void test_in_lockstep_senses_begin_the_count_of_silences_anew(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(0, 1));
    silences(9);
    senses_come(910, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    silences(9);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, owner_starts(1820, 2));
}

static void test_in_lockstep_an_owner_that_never_sends_senses_is_soon_no_owner(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(0, 1));
    silences(10);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1010, 2));
    silences(1);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1110, 3));
}

static void test_an_answer_that_is_given_again_is_no_fault(void)
{
    const struct output drive = {.has_drive = true};

    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(0, 1));
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(0, hal_send(hal, &drive));
    senses_come(10, 0);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsent = 0});
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_silence_counts_from_the_last_senses_whatever_else_comes);
    RUN_TEST(test_held_up_for_the_limit_it_takes_the_newest_senses);
    RUN_TEST(test_held_up_for_less_it_takes_the_next_senses);
    RUN_TEST(test_held_up_for_longer_with_nothing_of_use_it_reports_silence_at_once);
    RUN_TEST(test_looking_for_the_newest_senses_takes_no_time_and_no_look_too_many);
    RUN_TEST(test_of_senses_without_end_so_many_are_looked_at);
    RUN_TEST(test_opened_again_it_has_heard_of_no_silence);
    RUN_TEST(test_in_lockstep_senses_begin_the_count_of_silences_anew);
    RUN_TEST(test_in_lockstep_an_owner_that_never_sends_senses_is_soon_no_owner);
    RUN_TEST(test_an_answer_that_is_given_again_is_no_fault);
    return UNITY_END();
}
