/* Silence, and the stop: the wheels rest, and it goes on where it was. */
#include "firmware/robot.h"

#include <string.h>

#include "tests/test.h"
#include "robot_rig.h"

void setUp(void)
{
    wheels = (struct senses){.tick = 0};
    robot_init(&robot, 1);
    command(OPCODE_START, PROFILE_ARTICLE, 1);
}

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
