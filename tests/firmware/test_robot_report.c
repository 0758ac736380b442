/* What a robot tells of itself, and when. */
#include "firmware/robot.h"
#include "tests/test.h"
#include "robot_rig.h"

TEST(every_tenth_silence_brings_a_report)
{
    for (unsigned i = 1; i <= 100; i++) {
        silence();
        TEST_ASSERT_EQUAL(i % 10 == 0, out.has_report);
    }
}

TEST(senses_begin_the_count_of_silences_anew)
{
    for (unsigned i = 0; i < 9; i++)
        silence();
    feel(CLEAR);
    silence();
    TEST_ASSERT_FALSE(out.has_report);
}

TEST(a_report_comes_once_a_second)
{
    for (unsigned tick = 1; tick <= MANY; tick++) {
        feel(CLEAR);
        TEST_ASSERT_EQUAL(tick % TICKS_PER_SECOND == 0, out.has_report);
    }
}

TEST(a_report_has_the_memory)
{
    learned(SIDE_RIGHT);
    for (unsigned tick = 1; tick <= TICKS_PER_SECOND; tick++)
        feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_FALSE(out.has_memory);   /* it has not changed: the report brings it */
    TEST_ASSERT_EQUAL_UINT8(SIDE_RIGHT, out.memory[PATTERN_FRONT]);
}

TEST(what_a_report_tells_is_there_when_none_is_due)
{
    robot.uptime_s = 77;
    feel(CLEAR);
    TEST_ASSERT_FALSE(out.has_report);
    TEST_ASSERT_TRUE(out.report.running);
    TEST_ASSERT_EQUAL_UINT16(77, out.report.uptime_s);
    TEST_ASSERT_EQUAL_UINT8(PROFILE_ARTICLE, out.report.profile);
}

TEST(a_stopped_robot_reports_too)
{
    robot_init(&robot, 1);
    for (unsigned tick = 1; tick <= TICKS_PER_SECOND; tick++)
        feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_report);
}

TEST(reports_keep_to_the_second_with_any_tick)
{
    unsigned reports = 0;

    command(OPCODE_SET, TICK_MS, 100);
    for (unsigned tick = 0; tick < 100; tick++) {
        feel(CLEAR);
        reports += out.has_report;
    }
    TEST_ASSERT_EQUAL_UINT(10, reports);
}

/* 34 ticks of 30 ms are 1,020 ms: 20 of these belong to the next second. */
TEST(where_no_tick_ends_with_a_second_the_next_one_reports)
{
    command(OPCODE_SET, TICK_MS, 30);
    for (unsigned tick = 1; tick <= 134; tick++) {
        obey(CLEAR);
        TEST_ASSERT_EQUAL(tick == 34 || tick == 67 || tick == 100 || tick == 134, out.has_report);
    }
    TEST_ASSERT_EQUAL_UINT32(4, out.report.uptime_s);
}

/* The same ticks to the report as of a robot that was never started before. */
TEST(a_start_begins_a_second)
{
    static const uint8_t tick_ms[] = {20, 30, 100};

    for (unsigned before = 1; before < 2 * TICKS_PER_SECOND; before += 7) {
        command(OPCODE_SET, TICK_MS, tick_ms[before % sizeof tick_ms]);
        for (unsigned tick = 0; tick < before; tick++)
            feel(CLEAR);
        command(OPCODE_STOP, 0, 0);
        command(OPCODE_START, PROFILE_ARTICLE, 1);
        for (unsigned tick = 1; tick <= TICKS_PER_SECOND; tick++) {
            feel(CLEAR);
            TEST_ASSERT_EQUAL(tick == TICKS_PER_SECOND, out.has_report);
        }
    }
}

TEST(the_second_of_a_robot_that_runs_goes_on)
{
    for (unsigned tick = 1; tick <= TICKS_PER_SECOND; tick++) {
        command(OPCODE_START, PROFILE_ARTICLE, 1);
        feel(CLEAR);
        TEST_ASSERT_EQUAL(tick == TICKS_PER_SECOND, out.has_report);
    }
}

TEST(uptime_counts_seconds)
{
    for (unsigned tick = 0; tick < 90 * TICKS_PER_SECOND; tick++)
        feel(CLEAR);
    TEST_ASSERT_EQUAL_UINT16(90, out.report.uptime_s);
}

TEST(uptime_wraps)
{
    robot.uptime_s = UINT16_MAX;
    robot.part_ms = 980;
    feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_EQUAL_UINT16(0, out.report.uptime_s);
}

TEST(stop_is_answered_with_a_report)
{
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_TRUE(out.whole_report);
    TEST_ASSERT_FALSE(out.report.running);
}

TEST(a_report_is_made_when_it_is_asked_for)
{
    command(OPCODE_REPORT, 0, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_TRUE(out.whole_report);
    TEST_ASSERT_TRUE(out.report.running);
    TEST_ASSERT_FALSE(out.has_drive);
}

TEST(the_report_tells_a_frozen_robot)
{
    command(OPCODE_FREEZE, 1, 0);
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_TRUE(out.report.frozen);
}

TEST(the_report_tells_the_profile)
{
    for (uint8_t profile = 0; profile < PROFILE_COUNT; profile++) {
        command(OPCODE_START, profile, 1);
        command(OPCODE_STOP, 0, 0);
        TEST_ASSERT_EQUAL_UINT8(profile, out.report.profile);
    }
}

TEST(every_byte_of_the_memory_is_told)
{
    command(OPCODE_START, PROFILE_FIVE, 1);
    robot.brain.memory = (struct memory){{0xFF, 1, 2, 3, 4, 5, 6, 7}};
    command(OPCODE_REPORT, 0, 0);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(robot.brain.memory.cell, out.memory, CELL_COUNT);
}
