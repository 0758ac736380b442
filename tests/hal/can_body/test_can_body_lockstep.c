/* Lockstep: time is the other side's, and what was answered is answered again. */
#include "fake_body.h"

/* INPUT_SILENCE: the robot has another owner. */
static enum input_kind owner_starts(uint32_t at_ms, uint8_t owner)
{
    const struct output answer = {.has_answer = true};

    command_comes(at_ms, (struct octet_command_t){.opcode = OPCODE_START, .counter = 1, .owner = owner, .lockstep = 1});
    if (receive() != INPUT_COMMAND)
        return INPUT_SILENCE;
    TEST_ASSERT_EQUAL(0, hal_send(hal, &answer));
    return INPUT_COMMAND;
}

static void start_in_lockstep(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(0, 1));
}

static void silences(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
}

TEST(in_lockstep_silence_is_no_fault)
{
    start_in_lockstep();
    senses_come(0, 0);
    receive();
    for (uint32_t i = 1; i <= 50; i++) {
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
        TEST_ASSERT_EQUAL_UINT32(100 * i, fake.clock_ms);
    }
    assert_faults((struct octet_faults_t){.silences = 0});
}

TEST(in_lockstep_nothing_is_passed_over_after_silence)
{
    start_in_lockstep();
    for (unsigned tick = 0; tick < 3; tick++)
        senses_come(5000, tick);
    silences(49);
    for (unsigned tick = 0; tick < 3; tick++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT8(tick, in.senses.tick);
    }
}

TEST(in_lockstep_senses_that_came_again_meanwhile_are_not_stale)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    start_in_lockstep();
    for (unsigned i = 0; i < 3; i++)
        senses_come(150, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.silences = 0});
}

static enum input_kind other_owner_starts(uint32_t at_ms)
{
    command_comes(at_ms, (struct octet_command_t){.opcode = OPCODE_START, .counter = 9, .owner = 2});
    return (enum input_kind)receive();
}

TEST(in_lockstep_another_may_take_over_after_a_second)
{
    start_in_lockstep();
    silences(9);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, other_owner_starts(950));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, other_owner_starts(1050));
}

static void answered_senses_come_again(void)
{
    const struct output drive = {.has_drive = true};

    start_in_lockstep();
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(0, hal_send(hal, &drive));
    senses_come(50, 0);
}

TEST(what_was_answered_is_answered_again_at_once)
{
    answered_senses_come_again();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(OCTET_DRIVE_FRAME_ID, fake.sent[fake.sends - 1].id);
    TEST_ASSERT_EQUAL_MEMORY(&fake.sent[fake.sends - 2], &fake.sent[fake.sends - 1], sizeof(struct frame));
}

TEST(an_answer_again_that_does_not_leave_is_counted)
{
    answered_senses_come_again();
    fake.failure = LINK_E_FULL;
    fake.failing_send = fake.sends + 1;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsent = 1});
}

TEST(in_lockstep_senses_begin_the_count_of_silences_anew)
{
    start_in_lockstep();
    silences(9);
    senses_come(910, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    silences(9);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, owner_starts(1820, 2));
}

TEST(in_lockstep_an_owner_that_never_sends_senses_is_soon_no_owner)
{
    start_in_lockstep();
    silences(10);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1010, 2));
    silences(1);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1110, 3));
}

TEST(an_answer_that_is_given_again_is_no_fault)
{
    answered_senses_come_again();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsent = 0});
}

TEST(every_wait_gives_signs_of_life)
{
    start_in_lockstep();
    silences(30);
    TEST_ASSERT_EQUAL_UINT32(HAL_SILENCE_MS, fake.longest_wait_ms);
}
