/* Reports: what they contain, and when they are sent. */
#include "robot_rig.h"

#include "tests/test.h"
#include "firmware/robot.h"

#include <stdlib.h>

TEST(report_is_sent_every_tenth_silence)
{
    for (unsigned i = 1; i <= 100; i++) {
        silence();
        TEST_ASSERT_EQUAL(i % 10 == 0, out.has_report);
    }
}

TEST(senses_reset_the_count_of_silences)
{
    for (unsigned i = 0; i < 9; i++)
        silence();
    feel(CLEAR);
    silence();
    TEST_ASSERT_FALSE(out.has_report);
}

TEST(report_is_sent_once_a_second)
{
    for (unsigned tick = 1; tick <= MANY; tick++) {
        feel(CLEAR);
        TEST_ASSERT_EQUAL(tick % TICKS_PER_SECOND == 0, out.has_report);
    }
}

TEST(report_contains_the_memory)
{
    teach(SIDE_RIGHT);
    for (unsigned tick = 1; tick <= TICKS_PER_SECOND; tick++)
        feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_FALSE(out.has_memory);   /* it has not changed: the report brings it */
    TEST_ASSERT_EQUAL_UINT8(SIDE_RIGHT, out.memory[PATTERN_FRONT]);
}

TEST(report_content_is_current_when_no_report_is_due)
{
    robot.uptime_s = 77;
    feel(CLEAR);
    TEST_ASSERT_FALSE(out.has_report);
    TEST_ASSERT_TRUE(out.report.running);
    TEST_ASSERT_EQUAL_UINT16(77, out.report.uptime_s);
    TEST_ASSERT_EQUAL_UINT8(PROFILE_ARTICLE, out.report.profile);
}

TEST(stopped_robot_sends_reports)
{
    robot_init(&robot, 1);
    for (unsigned tick = 1; tick <= TICKS_PER_SECOND; tick++)
        feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_report);
}

TEST(report_interval_is_a_second_for_any_tick)
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
TEST(report_is_sent_in_the_first_tick_after_the_second)
{
    command(OPCODE_SET, TICK_MS, 30);
    for (unsigned tick = 1; tick <= 134; tick++) {
        obey(CLEAR);
        TEST_ASSERT_EQUAL(tick == 34 || tick == 67 || tick == 100 || tick == 134, out.has_report);
    }
    TEST_ASSERT_EQUAL_UINT32(4, out.report.uptime_s);
}

/* The report comes after as many ticks as of a robot that was never started before. */
TEST(start_of_a_stopped_robot_restarts_the_report_interval)
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

TEST(start_of_a_running_robot_keeps_the_report_interval)
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

TEST(report_command_yields_a_report)
{
    command(OPCODE_REPORT, 0, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_TRUE(out.whole_report);
    TEST_ASSERT_TRUE(out.report.running);
    TEST_ASSERT_FALSE(out.has_drive);
}

TEST(report_shows_whether_learning_is_frozen)
{
    command(OPCODE_FREEZE, 1, 0);
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_TRUE(out.report.frozen);
}

TEST(report_shows_the_profile)
{
    for (uint8_t profile = 0; profile < PROFILE_COUNT; profile++) {
        command(OPCODE_START, profile, 1);
        command(OPCODE_STOP, 0, 0);
        TEST_ASSERT_EQUAL_UINT8(profile, out.report.profile);
    }
}

TEST(report_contains_every_byte_of_the_memory)
{
    command(OPCODE_START, PROFILE_FIVE, 1);
    robot.brain.memory = (struct memory){{0xFF, 1, 2, 3, 4, 5, 6, 7}};
    command(OPCODE_REPORT, 0, 0);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(robot.brain.memory.cell, out.memory, CELL_COUNT);
}

/* A body that restarts in the middle of a turn: its odometers restart at 0, and the turn continues. */

enum {
    TRIAL_COUNTS = 1257, TWO_DEGREES = 56,   /* left minus right wheel: 45 degrees are 1256.6 counts, one degree 27.9 */
    SILENCE_MS = 100, TICK = 20
};

static const unsigned OUTAGES_MS[] = {50, 100, 300, 1000};

/* The counts that the body has turned since these senses, right positive. */
static int turned(const struct senses *from)
{
    int left = (wheels.odometer_left - from->odometer_left) & (ODOMETER_SPAN - 1);
    int right = (wheels.odometer_right - from->odometer_right) & (ODOMETER_SPAN - 1);

    return (left < ODOMETER_SPAN / 2 ? left : left - ODOMETER_SPAN)
        - (right < ODOMETER_SPAN / 2 ? right : right - ODOMETER_SPAN);
}

/* A body whose odometers show these when a trial begins obeys for some ticks; the senses after that are yet to come.
 * Returns how far it has turned. */
static int turn_for(unsigned ticks, uint16_t left, uint16_t right)
{
    struct senses begun;

    setUp();
    wheels.odometer_left = left;
    wheels.odometer_right = right;
    obey(FRONT);
    begun = wheels;
    while (ticks-- > 0)
        obey(FRONT);
    return turned(&begun);
}

static void interrupt_for(unsigned ms)
{
    for (unsigned silent_ms = SILENCE_MS; silent_ms <= ms; silent_ms += SILENCE_MS)
        silence();
    wheels.tick = (uint8_t)(wheels.tick + ms / TICK);
}

/* Continues the trial with a body whose odometers show these. Returns how far that turns it. */
static int continue_turn_from(uint16_t left, uint16_t right)
{
    const struct senses anew = {.odometer_left = left, .odometer_right = right};
    const uint8_t trial = robot.action;

    wheels.odometer_left = left;
    wheels.odometer_right = right;
    sense(wheels);
    while (robot.action == trial)
        obey(FRONT);
    return turned(&anew);
}

TEST(restarted_body_completes_the_turn_exactly)
{
    for (unsigned i = 0; i < sizeof OUTAGES_MS / sizeof *OUTAGES_MS; i++)
        for (uint16_t left = 7; left < ODOMETER_SPAN; left += 130)
            for (uint16_t right = 5; right < ODOMETER_SPAN; right += 170) {
                int way = turn_for(5, left, right);

                interrupt_for(OUTAGES_MS[i]);
                way += continue_turn_from(0, 0);
                TEST_ASSERT_INT_WITHIN(TWO_DEGREES, TRIAL_COUNTS, abs(way));
            }
}

TEST(restart_of_the_body_is_a_contradiction)
{
    (void)turn_for(5, 300, 300);
    interrupt_for(300);
    wheels.odometer_left = wheels.odometer_right = 0;
    sense(wheels);
    TEST_ASSERT_TRUE(out.contradiction);
}

/* A body holds its last drive for 100 ms, and then stops. */
TEST(motion_during_silence_counts_toward_the_turn)
{
    for (unsigned i = 0; i < sizeof OUTAGES_MS / sizeof *OUTAGES_MS; i++) {
        int way = turn_for(2, 1000, 1000);
        int held = (int)(OUTAGES_MS[i] < SILENCE_MS ? OUTAGES_MS[i] : SILENCE_MS) / TICK * (out.drive.left_mm_s / 5);

        interrupt_for(OUTAGES_MS[i]);
        way += 2 * held + continue_turn_from((uint16_t)(wheels.odometer_left + held), (uint16_t)(wheels.odometer_right - held));
        TEST_ASSERT_INT_WITHIN(TWO_DEGREES, TRIAL_COUNTS, abs(way));
        TEST_ASSERT_FALSE(out.contradiction);
    }
}

/* At any tick number: a restarted body may begin with any. */
TEST(motion_beyond_the_hold_time_is_a_contradiction)
{
    for (unsigned silences = 0; silences <= 21; silences++) {
        setUp();
        obey(CLEAR);
        interrupt_for(SILENCE_MS * silences);
        wheels.odometer_left = wheels.odometer_right = 500;
        wheels.tick += 200;
        sense(wheels);
        TEST_ASSERT_TRUE(out.contradiction);
    }
}

TEST(odometers_that_stay_at_0_are_no_restart)
{
    obey(CLEAR);
    interrupt_for(300);
    wheels.odometer_left = wheels.odometer_right = 0;
    sense(wheels);
    TEST_ASSERT_FALSE(out.contradiction);
}

TEST(stopping_the_robot_clears_the_backlog)
{
    robot.motion.apart.counts = robot.motion.together.counts = 100;
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_EQUAL_INT32(0, robot.motion.apart.counts);
    TEST_ASSERT_EQUAL_INT32(0, robot.motion.together.counts);
    TEST_ASSERT_FALSE(robot.motion.referenced);
}
