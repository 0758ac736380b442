#include "firmware/robot.h"

#include <string.h>

#include <unity.h>

#include "robot_rig.h"

void setUp(void)
{
    wheels = (struct senses){.tick = 0};
    robot_init(&robot, 1);
    command(OPCODE_START, PROFILE_ARTICLE, 1);
}

void tearDown(void) {}

static void test_after_power_up_it_rests(void)
{
    robot_init(&robot, 1);
    feel(CLEAR);
    assert_at_rest();
}

static void test_after_power_up_it_knows_nothing(void)
{
    static const uint8_t nothing[CELL_COUNT] = {0};

    robot_init(&robot, 1);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(nothing, robot.brain.memory.cell, CELL_COUNT);
}

static void test_a_drive_answers_the_tick_of_its_senses(void)
{
    sense((struct senses){.tick = 255});
    TEST_ASSERT_EQUAL_UINT8(255, out.drive.tick);
}

static void test_a_clear_way_is_driven(void)
{
    feel(CLEAR);
    TEST_ASSERT_EQUAL(REASON_WANDER, out.drive.reason);
    TEST_ASSERT_GREATER_THAN_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(out.drive.left_mm_s, out.drive.right_mm_s);
}

static void test_a_remembered_left_turns_the_left_wheel_back(void)
{
    learned(SIDE_LEFT);
    feel(FRONT);
    TEST_ASSERT_LESS_THAN_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_GREATER_THAN_INT16(0, out.drive.right_mm_s);
}

static void test_the_wheels_stop_in_the_tick_that_brings_an_obstacle(void)
{
    feel(CLEAR);
    sense((struct senses){.feel = FRONT, .look = true, .beacon_mm = 100});   /* the step ends, and it eats */
    TEST_ASSERT_EQUAL_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(0, out.drive.right_mm_s);
}

static void test_food_is_eaten_for_exactly_one_tick(void)
{
    const struct senses near_food = {.look = true, .beacon_mm = 100};
    const struct senses at_the_end = {
        .tick = 10, .look = true, .beacon_mm = 100, .odometer_left = 120, .odometer_right = 120};

    sense(near_food);
    TEST_ASSERT_FALSE(out.drive.eat);
    sense(at_the_end);
    TEST_ASSERT_TRUE(out.drive.eat);
    sense(at_the_end);
    TEST_ASSERT_FALSE(out.drive.eat);
}

static void test_trials_eat_nothing(void)
{
    for (unsigned i = 0; i < MANY; i++) {
        feel(FRONT);
        TEST_ASSERT_FALSE(out.drive.eat);
    }
}

static void test_the_drive_tells_the_repeat_count(void)
{
    learned(SIDE_LEFT);
    feel(FRONT);
    TEST_ASSERT_EQUAL_UINT8(1, out.drive.repeat_count);
}

static void test_an_action_keeps_its_number_while_it_lasts(void)
{
    uint8_t number;

    feel(CLEAR);
    number = out.drive.action;
    feel(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(number, out.drive.action);
}

static void test_actions_are_numbered_0_to_127_round_and_round(void)
{
    uint8_t last = out.drive.action;
    unsigned changes = 0;

    for (unsigned i = 0; i < 100 * MANY && changes < 300; i++) {
        obey(FRONT);
        if (out.drive.action == last)
            continue;
        TEST_ASSERT_EQUAL_UINT8((last + 1) % 128, out.drive.action);
        last = out.drive.action;
        changes++;
    }
    TEST_ASSERT_EQUAL_UINT(300, changes);
}

static void test_silence_rests_the_wheels_and_says_so(void)
{
    feel(CLEAR);
    silence();
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_SILENCE, out.drive.reason);
    TEST_ASSERT_TRUE(out.silent);
}

static void test_a_drive_in_silence_names_the_last_tick_and_action(void)
{
    uint8_t number;

    sense((struct senses){.tick = 255});
    number = out.drive.action;
    silence();
    TEST_ASSERT_EQUAL_UINT8(255, out.drive.tick);
    TEST_ASSERT_EQUAL_UINT8(number, out.drive.action);
}

static void test_silence_changes_nothing_but_its_count(void)
{
    struct robot before;

    feel(CLEAR);
    before = robot;
    silence();
    TEST_ASSERT_EQUAL_UINT8(before.silences + 1, robot.silences);
    before.silences = robot.silences;
    TEST_ASSERT_EQUAL_MEMORY(&before, &robot, sizeof robot);
}

static void test_after_silence_it_goes_on_where_it_was(void)
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

static void test_a_stopped_robot_says_in_silence_that_it_rests(void)
{
    command(OPCODE_STOP, 0, 0);
    silence();
    assert_at_rest();
}

static void test_stop_rests_the_wheels_at_once(void)
{
    feel(CLEAR);
    command(OPCODE_STOP, 0, 0);
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_STOP, out.drive.reason);
}

static void test_every_tenth_silence_brings_a_report(void)
{
    for (unsigned i = 1; i <= 100; i++) {
        silence();
        TEST_ASSERT_EQUAL(i % 10 == 0, out.has_report);
    }
}

static void test_senses_begin_the_count_of_silences_anew(void)
{
    for (unsigned i = 0; i < 9; i++)
        silence();
    feel(CLEAR);
    silence();
    TEST_ASSERT_FALSE(out.has_report);
}

static void test_a_report_comes_once_a_second(void)
{
    for (unsigned tick = 1; tick <= MANY; tick++) {
        feel(CLEAR);
        TEST_ASSERT_EQUAL(tick % TICKS_PER_SECOND == 0, out.has_report);
    }
}

static void test_a_report_has_the_memory(void)
{
    learned(SIDE_RIGHT);
    for (unsigned tick = 1; tick <= TICKS_PER_SECOND; tick++)
        feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_FALSE(out.has_memory);   /* it has not changed: the report brings it */
    TEST_ASSERT_EQUAL_UINT8(SIDE_RIGHT, out.memory[PATTERN_FRONT]);
}

static void test_what_a_report_tells_is_there_when_none_is_due(void)
{
    robot.uptime_s = 77;
    feel(CLEAR);
    TEST_ASSERT_FALSE(out.has_report);
    TEST_ASSERT_TRUE(out.report.running);
    TEST_ASSERT_EQUAL_UINT16(77, out.report.uptime_s);
    TEST_ASSERT_EQUAL_UINT8(PROFILE_ARTICLE, out.report.profile);
}

static void test_a_stopped_robot_reports_too(void)
{
    robot_init(&robot, 1);
    for (unsigned tick = 1; tick <= TICKS_PER_SECOND; tick++)
        feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_report);
}

static void test_reports_keep_to_the_second_with_any_tick(void)
{
    unsigned reports = 0;

    command(OPCODE_SET, TICK_MS, 100);
    for (unsigned tick = 0; tick < 100; tick++) {
        feel(CLEAR);
        reports += out.has_report;
    }
    TEST_ASSERT_EQUAL_UINT(10, reports);
}

static void test_uptime_counts_seconds(void)
{
    for (unsigned tick = 0; tick < 90 * TICKS_PER_SECOND; tick++)
        feel(CLEAR);
    TEST_ASSERT_EQUAL_UINT16(90, out.report.uptime_s);
}

static void test_uptime_wraps(void)
{
    robot.uptime_s = UINT16_MAX;
    robot.part_ms = 980;
    feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_EQUAL_UINT16(0, out.report.uptime_s);
}

static void test_stop_is_answered_with_a_report(void)
{
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_TRUE(out.whole_report);
    TEST_ASSERT_FALSE(out.report.running);
}

static void test_a_report_is_made_when_it_is_asked_for(void)
{
    command(OPCODE_REPORT, 0, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_TRUE(out.has_report);
    TEST_ASSERT_TRUE(out.whole_report);
    TEST_ASSERT_TRUE(out.report.running);
    TEST_ASSERT_FALSE(out.has_drive);
}

static void test_the_report_tells_a_frozen_robot(void)
{
    command(OPCODE_FREEZE, 1, 0);
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_TRUE(out.report.frozen);
}

static void test_a_command_is_answered_and_not_driven(void)
{
    command(OPCODE_RESUME, 0, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_EQUAL(RESULT_DONE, out.answer);
    TEST_ASSERT_FALSE(out.has_drive);
}

static void test_a_refusal_is_answered(void)
{
    command(OPCODE_SET, PARAMETER_COUNT, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_EQUAL(RESULT_UNKNOWN_PARAMETER, out.answer);
}

static void test_senses_are_driven_and_not_answered(void)
{
    feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_drive);
    TEST_ASSERT_FALSE(out.has_answer);
}

static void test_a_written_memory_is_sent_and_stored_once(void)
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
static void test_a_lesson_is_sent_and_stored_as_it_is_learned(void)
{
    struct senses after = {.tick = 10, .feel = CLEAR, .odometer_left = 628, .odometer_right = ODOMETER_SPAN - 628};

    feel(FRONT);
    if (out.drive.left_mm_s < 0)
        after = (struct senses){.tick = 10, .feel = CLEAR, .odometer_left = ODOMETER_SPAN - 628, .odometer_right = 628};
    sense(after);
    TEST_ASSERT_TRUE(out.has_memory);
    TEST_ASSERT_TRUE(out.store);
    TEST_ASSERT_TRUE(out.memory[PATTERN_FRONT] != SIDE_NOTHING);
}

static void test_the_turns_of_a_fixed_robot_are_sent_and_not_stored(void)
{
    command(OPCODE_START, PROFILE_FIXED, 1);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_TRUE(out.has_memory);
    TEST_ASSERT_FALSE(out.store);
    TEST_ASSERT_EQUAL_UINT8(SIDE_LEFT, out.memory[PATTERN_FRONT]);
}

static void test_what_is_written_to_a_robot_that_does_not_learn_is_not_stored(void)
{
    command(OPCODE_START, PROFILE_FIXED, 1);
    command(OPCODE_WRITE, 1u << PATTERN_FRONT, SIDE_RIGHT << 8 * PATTERN_FRONT);
    TEST_ASSERT_EQUAL_UINT8(SIDE_RIGHT, out.memory[PATTERN_FRONT]);
    TEST_ASSERT_FALSE(out.store);
}

static void test_the_report_tells_the_profile(void)
{
    for (uint8_t profile = 0; profile < PROFILE_COUNT; profile++) {
        command(OPCODE_START, profile, 1);
        command(OPCODE_STOP, 0, 0);
        TEST_ASSERT_EQUAL_UINT8(profile, out.report.profile);
    }
}

static void test_a_report_alone_stores_nothing(void)
{
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_FALSE(out.store);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_after_power_up_it_rests);
    RUN_TEST(test_after_power_up_it_knows_nothing);
    RUN_TEST(test_a_drive_answers_the_tick_of_its_senses);
    RUN_TEST(test_a_clear_way_is_driven);
    RUN_TEST(test_a_remembered_left_turns_the_left_wheel_back);
    RUN_TEST(test_the_wheels_stop_in_the_tick_that_brings_an_obstacle);
    RUN_TEST(test_food_is_eaten_for_exactly_one_tick);
    RUN_TEST(test_trials_eat_nothing);
    RUN_TEST(test_the_drive_tells_the_repeat_count);
    RUN_TEST(test_an_action_keeps_its_number_while_it_lasts);
    RUN_TEST(test_actions_are_numbered_0_to_127_round_and_round);
    RUN_TEST(test_silence_rests_the_wheels_and_says_so);
    RUN_TEST(test_a_drive_in_silence_names_the_last_tick_and_action);
    RUN_TEST(test_silence_changes_nothing_but_its_count);
    RUN_TEST(test_after_silence_it_goes_on_where_it_was);
    RUN_TEST(test_a_stopped_robot_says_in_silence_that_it_rests);
    RUN_TEST(test_stop_rests_the_wheels_at_once);
    RUN_TEST(test_every_tenth_silence_brings_a_report);
    RUN_TEST(test_senses_begin_the_count_of_silences_anew);
    RUN_TEST(test_a_report_comes_once_a_second);
    RUN_TEST(test_a_report_has_the_memory);
    RUN_TEST(test_what_a_report_tells_is_there_when_none_is_due);
    RUN_TEST(test_a_stopped_robot_reports_too);
    RUN_TEST(test_reports_keep_to_the_second_with_any_tick);
    RUN_TEST(test_uptime_counts_seconds);
    RUN_TEST(test_uptime_wraps);
    RUN_TEST(test_stop_is_answered_with_a_report);
    RUN_TEST(test_a_report_is_made_when_it_is_asked_for);
    RUN_TEST(test_the_report_tells_a_frozen_robot);
    RUN_TEST(test_a_command_is_answered_and_not_driven);
    RUN_TEST(test_a_refusal_is_answered);
    RUN_TEST(test_senses_are_driven_and_not_answered);
    RUN_TEST(test_a_written_memory_is_sent_and_stored_once);
    RUN_TEST(test_a_lesson_is_sent_and_stored_as_it_is_learned);
    RUN_TEST(test_the_turns_of_a_fixed_robot_are_sent_and_not_stored);
    RUN_TEST(test_what_is_written_to_a_robot_that_does_not_learn_is_not_stored);
    RUN_TEST(test_the_report_tells_the_profile);
    RUN_TEST(test_a_report_alone_stores_nothing);
    return UNITY_END();
}
