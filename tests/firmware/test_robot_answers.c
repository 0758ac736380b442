/* What commands and lessons bring: an answer, the memory, and whether it is stored. */
#include "firmware/robot.h"

#include <string.h>

#include "tests/test.h"
#include "robot_rig.h"

TEST(a_command_is_answered_and_not_driven)
{
    command(OPCODE_RESUME, 0, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_EQUAL(RESULT_DONE, out.answer);
    TEST_ASSERT_FALSE(out.has_drive);
}

TEST(a_refusal_is_answered)
{
    command(OPCODE_SET, PARAMETER_COUNT, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_EQUAL(RESULT_UNKNOWN_PARAMETER, out.answer);
}

TEST(senses_are_driven_and_not_answered)
{
    feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_drive);
    TEST_ASSERT_FALSE(out.has_answer);
}

TEST(a_written_memory_is_sent_and_stored_once)
{
    command(OPCODE_WRITE, 1u << PATTERN_FRONT, SIDE_LEFT << 8 * PATTERN_FRONT);
    TEST_ASSERT_TRUE(out.has_memory);
    TEST_ASSERT_TRUE(out.store);
    TEST_ASSERT_EQUAL_UINT8(SIDE_LEFT, out.memory[PATTERN_FRONT]);
    feel(CLEAR);
    TEST_ASSERT_FALSE(out.has_memory);
    TEST_ASSERT_FALSE(out.store);
}

/* A trial of 45 degrees is 1257 counts of difference between the wheels. */
TEST(a_lesson_is_sent_and_stored_as_it_is_learned)
{
    feel(FRONT);
    for (uint8_t tick = 5; tick <= 10; tick += 5) {
        uint16_t rolled = (uint16_t)(tick == 5 ? 314 : 628);
        uint16_t back = (uint16_t)(ODOMETER_SPAN - rolled);
        bool left = out.drive.left_mm_s < 0;

        sense((struct senses){.tick = tick, .odometer_left = left ? back : rolled, .odometer_right = left ? rolled : back});
    }
    TEST_ASSERT_TRUE(out.has_memory);
    TEST_ASSERT_TRUE(out.store);
    TEST_ASSERT_NOT_EQUAL_UINT8(SIDE_NOTHING, out.memory[PATTERN_FRONT]);
}

TEST(the_turns_of_a_fixed_robot_are_sent_and_not_stored)
{
    command(OPCODE_START, PROFILE_FIXED, 1);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_TRUE(out.has_memory);
    TEST_ASSERT_FALSE(out.store);
    TEST_ASSERT_EQUAL_UINT8(SIDE_LEFT, out.memory[PATTERN_FRONT]);
}

TEST(what_is_written_to_a_robot_that_does_not_learn_is_not_stored)
{
    command(OPCODE_START, PROFILE_FIXED, 1);
    command(OPCODE_WRITE, 1u << PATTERN_FRONT, SIDE_RIGHT << 8 * PATTERN_FRONT);
    TEST_ASSERT_EQUAL_UINT8(SIDE_RIGHT, out.memory[PATTERN_FRONT]);
    TEST_ASSERT_FALSE(out.store);
}

TEST(a_report_alone_stores_nothing)
{
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_FALSE(out.store);
}

/* Silence, and the stop: the wheels rest, and it goes on where it was. */

TEST(silence_rests_the_wheels_and_says_so)
{
    feel(CLEAR);
    silence();
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_SILENCE, out.drive.reason);
    TEST_ASSERT_TRUE(out.silent);
}

TEST(a_drive_in_silence_names_the_last_tick_and_action)
{
    uint8_t number;

    sense((struct senses){.tick = 255});
    number = out.drive.action;
    silence();
    TEST_ASSERT_EQUAL_UINT8(255, out.drive.tick);
    TEST_ASSERT_EQUAL_UINT8(number, out.drive.action);
}

TEST(silence_changes_nothing_but_its_count)
{
    struct robot before;

    feel(CLEAR);
    before = robot;
    silence();
    TEST_ASSERT_EQUAL_UINT8(before.silences + 1, robot.silences);
    before.silences = robot.silences;
    TEST_ASSERT_EQUAL_MEMORY(&before, &robot, sizeof robot);
}

TEST(after_silence_it_goes_on_where_it_was)
{
    struct drive expected;
    struct robot before;

    feel(CLEAR);
    before = robot;
    feel(CLEAR);
    expected = out.drive;
    robot = before;
    silence();
    feel(CLEAR);
    TEST_ASSERT_EQUAL_INT16(expected.left_mm_s, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL_UINT8(expected.action, out.drive.action);
    TEST_ASSERT_EQUAL(expected.reason, out.drive.reason);
}

TEST(a_stopped_robot_says_in_silence_that_it_rests)
{
    command(OPCODE_STOP, 0, 0);
    silence();
    assert_at_rest();
}

TEST(stop_rests_the_wheels_at_once)
{
    feel(CLEAR);
    command(OPCODE_STOP, 0, 0);
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_STOP, out.drive.reason);
}

TEST(the_drive_that_answers_a_stop_names_the_tick_and_the_action)
{
    sense((struct senses){.tick = 77});
    command(OPCODE_STOP, 0, 0);
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_STOP, out.drive.reason);
    TEST_ASSERT_EQUAL_UINT8(77, out.drive.tick);
    TEST_ASSERT_EQUAL_UINT8(1, out.drive.action);
}
