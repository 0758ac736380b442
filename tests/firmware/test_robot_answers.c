/* What commands and lessons bring: an answer, the memory, and whether it is stored. */
#include "firmware/robot.h"
#include "tests/test.h"
#include "robot_rig.h"

void setUp(void)
{
    wheels = (struct senses){.tick = 0};
    robot_init(&robot, 1);
    command(OPCODE_START, PROFILE_ARTICLE, 1);
}

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
