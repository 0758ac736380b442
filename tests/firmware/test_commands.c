#include <unity.h>

#include "firmware/robot.h"

enum { UPPER = 16 /* half of the memory */, CLEAR = 0, FRONT = 4, PATTERN_FRONT = 2 };

static struct robot robot;

static uint32_t value_told;

static enum result execute(enum opcode opcode, unsigned which, uint32_t value)
{
    const struct command command = {.opcode = opcode, .which = (uint8_t)which, .value = value};

    return robot_execute(&robot, &command, &value_told);
}

static struct drive step(uint8_t feel)
{
    const struct senses senses = {.feel = feel};
    struct drive drive;

    robot_step(&robot, &senses, &drive);
    return drive;
}

/* A robot in the middle of things: running, with a lesson learned and a turn under way. */
void setUp(void)
{
    robot_init(&robot, 1);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_START, PROFILE_ARTICLE, 42));
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_WRITE, 1u << PATTERN_FRONT, SIDE_LEFT << 8 * PATTERN_FRONT));
    robot.brain.changed = false;
    step(FRONT);
}

void tearDown(void) {}

static void assert_refused(enum result why, enum opcode opcode, unsigned which, uint32_t value)
{
    const struct robot before = robot;

    TEST_ASSERT_EQUAL(why, execute(opcode, which, value));
    TEST_ASSERT_EQUAL_MEMORY(&before, &robot, sizeof robot);
}

static void test_an_unknown_command_changes_nothing(void)
{
    assert_refused(RESULT_UNKNOWN_COMMAND, (enum opcode)0, 0, 0);
    for (unsigned opcode = OPCODE_REPORT + 1; opcode <= UINT8_MAX; opcode++)
        assert_refused(RESULT_UNKNOWN_COMMAND, (enum opcode)opcode, 0, 0);
}

static void test_stop_rests_the_wheels(void)
{
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_STOP, 0, 0));
    TEST_ASSERT_EQUAL_INT16(0, step(FRONT).left_mm_s);
    TEST_ASSERT_EQUAL(REASON_STOP, step(FRONT).reason);
}

static void test_resume_goes_on_with_the_turn_under_way(void)
{
    const struct drive before = step(FRONT);

    execute(OPCODE_STOP, 0, 0);
    step(FRONT);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_RESUME, 0, 0));
    TEST_ASSERT_EQUAL_INT16(before.left_mm_s, step(FRONT).left_mm_s);
}

/* Whoever stopped the robot may have carried it elsewhere. */
static void test_resume_takes_no_notice_of_what_the_wheels_did_meanwhile(void)
{
    const struct senses elsewhere = {.feel = FRONT, .odometer_left = 300, .odometer_right = 200};
    const int32_t before = robot.motion.turn_left;
    struct drive drive;

    execute(OPCODE_STOP, 0, 0);
    execute(OPCODE_RESUME, 0, 0);
    robot_step(&robot, &elsewhere, &drive);
    TEST_ASSERT_EQUAL_INT32(before, robot.motion.turn_left);
}

static void test_start_runs_the_robot(void)
{
    execute(OPCODE_STOP, 0, 0);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_START, PROFILE_ARTICLE, 1));
    TEST_ASSERT_GREATER_THAN_INT16(0, step(CLEAR).left_mm_s);
}

static void test_start_keeps_what_was_learned(void)
{
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&robot.brain.memory, PATTERN_FRONT));
}

static void test_start_loads_the_profile(void)
{
    execute(OPCODE_SET, STEP_MM, 100);
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_UINT16(12, robot.config.value[STEP_MM]);
}

static void test_start_seeds_the_random_turns(void)
{
    struct random expected;

    random_seed(&expected, 0xDEADBEEF);
    execute(OPCODE_START, PROFILE_ARTICLE, 0xDEADBEEF);
    TEST_ASSERT_EQUAL_MEMORY(&expected, &robot.brain.random, sizeof expected);
}

static void test_start_lets_a_frozen_robot_learn_again(void)
{
    execute(OPCODE_FREEZE, 1, 0);
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_FALSE(robot.brain.frozen);
}

static void test_start_forgets_the_turn_under_way(void)
{
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL(REASON_WANDER, step(CLEAR).reason);
}

static void test_start_numbers_the_actions_anew(void)
{
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_UINT8(1, step(CLEAR).action);
}

static void test_start_with_an_unknown_profile_changes_nothing(void)
{
    for (unsigned profile = PROFILE_COUNT; profile <= UINT8_MAX; profile++)
        assert_refused(RESULT_UNKNOWN_PROFILE, OPCODE_START, profile, 7);
}

static void test_set_changes_one_parameter(void)
{
    struct config expected = robot.config;

    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_SET, TURN_DEG, 20));
    expected.value[TURN_DEG] = 20;
    TEST_ASSERT_EQUAL_MEMORY(&expected, &robot.config, sizeof expected);
}

static void test_an_unknown_parameter_changes_nothing(void)
{
    for (unsigned parameter = PARAMETER_COUNT; parameter <= UINT8_MAX; parameter++)
        assert_refused(RESULT_UNKNOWN_PARAMETER, OPCODE_SET, parameter, 10);
}

static void test_a_value_out_of_range_changes_nothing(void)
{
    for (unsigned parameter = 0; parameter < PARAMETER_COUNT; parameter++) {
        if (!config_fits((uint8_t)parameter, 0))
            assert_refused(RESULT_OUT_OF_RANGE, OPCODE_SET, parameter, 0);
        assert_refused(RESULT_OUT_OF_RANGE, OPCODE_SET, parameter, 1001);
        assert_refused(RESULT_OUT_OF_RANGE, OPCODE_SET, parameter, 0x10000 + 100);
    }
}

static void test_get_tells_one_parameter(void)
{
    execute(OPCODE_SET, STEP_MM, 100);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_GET, STEP_MM, 0));
    TEST_ASSERT_EQUAL_UINT32(100, value_told);
}

static void test_a_report_changes_nothing(void)
{
    assert_refused(RESULT_DONE, OPCODE_REPORT, 0, 0);
}

static void test_write_sets_the_cells_of_the_mask(void)
{
    static const uint8_t expected[CELL_COUNT] = {0, 0, SIDE_LEFT, 0, 0, 0, 0, SIDE_RIGHT};

    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_WRITE, UPPER | 1u << 3, (uint32_t)SIDE_RIGHT << 24));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, robot.brain.memory.cell, CELL_COUNT);
}

static void test_what_was_written_is_to_be_stored(void)
{
    execute(OPCODE_WRITE, UPPER | 1u << 3, (uint32_t)SIDE_RIGHT << 24);
    TEST_ASSERT_TRUE(robot.brain.changed);
}

static void test_writing_what_is_no_side_changes_nothing(void)
{
    assert_refused(RESULT_OUT_OF_RANGE, OPCODE_WRITE, UPPER | 0xF, 3u << 24);
    assert_refused(RESULT_OUT_OF_RANGE, OPCODE_WRITE, 0x01, SIDE_LEFT);
}

static void test_erase_empties_the_memory(void)
{
    static const uint8_t expected[CELL_COUNT] = {0};

    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_ERASE, 0, 0));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, robot.brain.memory.cell, CELL_COUNT);
}

static void test_what_was_erased_is_to_be_stored(void)
{
    execute(OPCODE_ERASE, 0, 0);
    TEST_ASSERT_TRUE(robot.brain.changed);
}

static void test_freeze_stops_learning(void)
{
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_FREEZE, 1, 0));
    TEST_ASSERT_TRUE(robot.brain.frozen);
}

static void test_freeze_0_lets_it_learn_again(void)
{
    execute(OPCODE_FREEZE, 1, 0);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_FREEZE, 0, 0));
    TEST_ASSERT_FALSE(robot.brain.frozen);
}

static void test_get_of_any_parameter_beyond_the_last_is_refused(void)
{
    for (unsigned parameter = PARAMETER_COUNT; parameter <= UINT8_MAX; parameter++)
        assert_refused(RESULT_UNKNOWN_PARAMETER, OPCODE_GET, parameter, 0);
}

/* Whoever stopped the robot may have carried it elsewhere while no senses came. */
static void test_where_the_wheels_were_before_a_stop_is_forgotten(void)
{
    TEST_ASSERT_TRUE(robot.motion.referenced);
    execute(OPCODE_STOP, 0, 0);
    TEST_ASSERT_FALSE(robot.motion.referenced);
}

static void test_start_trusts_every_sensor_again(void)
{
    static const struct perception fresh;

    execute(OPCODE_SET, DISTRUST, 1);
    step(FRONT);
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_MEMORY(&fresh, &robot.perception, sizeof fresh);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_an_unknown_command_changes_nothing);
    RUN_TEST(test_stop_rests_the_wheels);
    RUN_TEST(test_resume_goes_on_with_the_turn_under_way);
    RUN_TEST(test_resume_takes_no_notice_of_what_the_wheels_did_meanwhile);
    RUN_TEST(test_start_runs_the_robot);
    RUN_TEST(test_start_keeps_what_was_learned);
    RUN_TEST(test_start_loads_the_profile);
    RUN_TEST(test_start_seeds_the_random_turns);
    RUN_TEST(test_start_lets_a_frozen_robot_learn_again);
    RUN_TEST(test_start_forgets_the_turn_under_way);
    RUN_TEST(test_start_numbers_the_actions_anew);
    RUN_TEST(test_start_with_an_unknown_profile_changes_nothing);
    RUN_TEST(test_set_changes_one_parameter);
    RUN_TEST(test_an_unknown_parameter_changes_nothing);
    RUN_TEST(test_a_value_out_of_range_changes_nothing);
    RUN_TEST(test_get_tells_one_parameter);
    RUN_TEST(test_a_report_changes_nothing);
    RUN_TEST(test_write_sets_the_cells_of_the_mask);
    RUN_TEST(test_what_was_written_is_to_be_stored);
    RUN_TEST(test_writing_what_is_no_side_changes_nothing);
    RUN_TEST(test_erase_empties_the_memory);
    RUN_TEST(test_what_was_erased_is_to_be_stored);
    RUN_TEST(test_freeze_stops_learning);
    RUN_TEST(test_freeze_0_lets_it_learn_again);
    RUN_TEST(test_get_of_any_parameter_beyond_the_last_is_refused);
    RUN_TEST(test_where_the_wheels_were_before_a_stop_is_forgotten);
    RUN_TEST(test_start_trusts_every_sensor_again);
    return UNITY_END();
}
