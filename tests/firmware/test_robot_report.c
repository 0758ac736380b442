/* What a robot tells of itself, and when. */
#include "firmware/robot.h"

#include <unity.h>

#include "robot_rig.h"

void setUp(void)
{
    wheels = (struct senses){.tick = 0};
    robot_init(&robot, 1);
    command(OPCODE_START, PROFILE_ARTICLE, 1);
}

void tearDown(void) {}

/* 34 ticks of 30 ms are 1,020 ms: 20 of these belong to the next second. */
static void test_where_no_tick_ends_with_a_second_the_next_one_reports(void)
{
    command(OPCODE_SET, TICK_MS, 30);
    for (unsigned tick = 1; tick <= 134; tick++) {
        obey(CLEAR);
        TEST_ASSERT_EQUAL(tick == 34 || tick == 67 || tick == 100 || tick == 134, out.has_report);
    }
    TEST_ASSERT_EQUAL_UINT32(4, out.report.uptime_s);
}

static void test_the_drive_that_answers_a_stop_names_the_tick_and_the_action(void)
{
    sense((struct senses){.tick = 77});
    command(OPCODE_STOP, 0, 0);
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_STOP, out.drive.reason);
    TEST_ASSERT_EQUAL_UINT8(77, out.drive.tick);
    TEST_ASSERT_EQUAL_UINT8(1, out.drive.action);
}

static void test_every_byte_of_the_memory_is_told(void)
{
    command(OPCODE_START, PROFILE_FIVE, 1);
    robot.brain.memory = (struct memory){{0xFF, 1, 2, 3, 4, 5, 6, 7}};
    command(OPCODE_REPORT, 0, 0);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(robot.brain.memory.cell, out.memory, CELL_COUNT);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_where_no_tick_ends_with_a_second_the_next_one_reports);
    RUN_TEST(test_the_drive_that_answers_a_stop_names_the_tick_and_the_action);
    RUN_TEST(test_every_byte_of_the_memory_is_told);
    return UNITY_END();
}
