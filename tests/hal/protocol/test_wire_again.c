/* What comes again is answered again, and what is refused is answered with the reason. */
#include "tests/test.h"
#include "reading_rig.h"

TEST(in_lockstep_senses_again_before_any_answer_have_none)
{
    start(1, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(0));
    TEST_ASSERT_EQUAL(INPUT_SILENCE, read_tick(0));
    TEST_ASSERT_NULL(wire.again);
}

TEST(in_lockstep_senses_again_are_answered_as_before)
{
    struct frame drive;

    start(1, 0);
    read_tick(5);
    drive = respond((struct output){.has_drive = true, .drive = {.tick = 5, .left_mm_s = 200}});
    refuse(senses_frame(NODE, 5));
    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_EQUAL_MEMORY(&drive, wire.again, sizeof drive);
}

TEST(what_was_said_in_silence_is_not_said_again)
{
    struct frame drive;

    start(1, 0);
    read_tick(5);
    drive = respond((struct output){.has_drive = true, .drive = {.tick = 5, .left_mm_s = 200}});
    respond((struct output){.has_drive = true, .silent = true, .drive = {.tick = 5}});
    refuse(senses_frame(NODE, 5));
    TEST_ASSERT_EQUAL_MEMORY(&drive, wire.again, sizeof drive);
}

TEST(a_command_again_is_answered_as_before)
{
    struct frame answer;

    hear(command_of(OPCODE_ERASE, 7, OWNER));
    answer = respond((struct output){.has_answer = true});
    refuse(command_of(OPCODE_ERASE, 7, OWNER));
    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_EQUAL_MEMORY(&answer, wire.again, sizeof answer);
}

TEST(what_was_said_goes_out_again_only_where_it_is_asked_for_again)
{
    hear(command_of(OPCODE_ERASE, 7, OWNER));
    respond((struct output){.has_answer = true});
    refuse(command_of(OPCODE_ERASE, 7, OWNER));
    refuse(senses_frame(NODE + 1, 0));
    expect(FAULT_FOREIGN, 1);
    TEST_ASSERT_NULL(wire.again);
}

static void assert_answer(enum result result, uint8_t counter)
{
    struct octet_answer_t answer;

    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_TRUE(e2e_is_whole(wire.again, OCTET_ANSWER_LENGTH));
    TEST_ASSERT_EQUAL_UINT32(OCTET_ANSWER_FRAME_ID, wire.again->id);
    TEST_ASSERT_EQUAL(0, octet_answer_unpack(&answer, wire.again->data, wire.again->len));
    TEST_ASSERT_EQUAL_UINT8(result, answer.result);
    TEST_ASSERT_EQUAL_UINT8(counter, answer.counter);
}

TEST(a_command_of_another_sender_is_answered_with_the_reason)
{
    start(0, 0);
    refuse(command_of(OPCODE_ERASE, 2, OWNER + 1));
    assert_answer(RESULT_OWNED, 2);
    expect(FAULT_REFUSED, 1);
}

TEST(an_old_command_is_answered_with_the_reason)
{
    start(0, 0);
    refuse(command_of(OPCODE_ERASE, 0, OWNER));
    assert_answer(RESULT_OUT_OF_SEQUENCE, 0);
    expect(FAULT_STALE, 1);
}
