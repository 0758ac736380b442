#include "tests/test.h"
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

static void assert_refused(enum result why, enum opcode opcode, unsigned which, uint32_t value)
{
    const struct robot before = robot;

    TEST_ASSERT_EQUAL(why, execute(opcode, which, value));
    TEST_ASSERT_EQUAL_MEMORY(&before, &robot, sizeof robot);
}

TEST(an_unknown_command_changes_nothing)
{
    assert_refused(RESULT_UNKNOWN_COMMAND, (enum opcode)0, 0, 0);
    for (unsigned opcode = OPCODE_REPORT + 1; opcode <= UINT8_MAX; opcode++)
        assert_refused(RESULT_UNKNOWN_COMMAND, (enum opcode)opcode, 0, 0);
}

TEST(stop_rests_the_wheels)
{
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_STOP, 0, 0));
    TEST_ASSERT_EQUAL_INT16(0, step(FRONT).left_mm_s);
    TEST_ASSERT_EQUAL(REASON_STOP, step(FRONT).reason);
}

TEST(resume_goes_on_with_the_turn_under_way)
{
    const struct drive before = step(FRONT);

    execute(OPCODE_STOP, 0, 0);
    step(FRONT);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_RESUME, 0, 0));
    TEST_ASSERT_EQUAL_INT16(before.left_mm_s, step(FRONT).left_mm_s);
}

/* Whoever stopped the robot may have carried it elsewhere. */
TEST(resume_takes_no_notice_of_what_the_wheels_did_meanwhile)
{
    const struct senses elsewhere = {.feel = FRONT, .odometer_left = 300, .odometer_right = 200};
    const int32_t before = robot.motion.turn_left;
    struct drive drive;

    execute(OPCODE_STOP, 0, 0);
    execute(OPCODE_RESUME, 0, 0);
    robot_step(&robot, &elsewhere, &drive);
    TEST_ASSERT_EQUAL_INT32(before, robot.motion.turn_left);
}

TEST(start_runs_the_robot)
{
    execute(OPCODE_STOP, 0, 0);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_START, PROFILE_ARTICLE, 1));
    TEST_ASSERT_GREATER_THAN_INT16(0, step(CLEAR).left_mm_s);
}

TEST(start_keeps_what_was_learned)
{
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&robot.brain.memory, PATTERN_FRONT));
}

TEST(start_loads_the_profile)
{
    execute(OPCODE_SET, STEP_MM, 100);
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_UINT16(12, robot.config.value[STEP_MM]);
}

TEST(start_seeds_the_random_turns)
{
    struct random expected;

    random_seed(&expected, 0xDEADBEEF);
    execute(OPCODE_START, PROFILE_ARTICLE, 0xDEADBEEF);
    TEST_ASSERT_EQUAL_MEMORY(&expected, &robot.brain.random, sizeof expected);
}

TEST(start_lets_a_frozen_robot_learn_again)
{
    execute(OPCODE_FREEZE, 1, 0);
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_FALSE(robot.brain.frozen);
}

TEST(start_forgets_the_turn_under_way)
{
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL(REASON_WANDER, step(CLEAR).reason);
}

TEST(start_numbers_the_actions_anew)
{
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_UINT8(1, step(CLEAR).action);
}

TEST(start_with_an_unknown_profile_changes_nothing)
{
    for (unsigned profile = PROFILE_COUNT; profile <= UINT8_MAX; profile++)
        assert_refused(RESULT_UNKNOWN_PROFILE, OPCODE_START, profile, 7);
}

TEST(set_changes_one_parameter)
{
    struct config expected = robot.config;

    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_SET, TURN_DEG, 20));
    expected.value[TURN_DEG] = 20;
    TEST_ASSERT_EQUAL_MEMORY(&expected, &robot.config, sizeof expected);
}

TEST(an_unknown_parameter_changes_nothing)
{
    for (unsigned parameter = PARAMETER_COUNT; parameter <= UINT8_MAX; parameter++) {
        assert_refused(RESULT_UNKNOWN_PARAMETER, OPCODE_SET, parameter, 10);
        assert_refused(RESULT_UNKNOWN_PARAMETER, OPCODE_GET, parameter, 0);
    }
}

TEST(a_value_out_of_range_changes_nothing)
{
    for (unsigned parameter = 0; parameter < PARAMETER_COUNT; parameter++) {
        if (!config_fits((uint8_t)parameter, 0))
            assert_refused(RESULT_OUT_OF_RANGE, OPCODE_SET, parameter, 0);
        assert_refused(RESULT_OUT_OF_RANGE, OPCODE_SET, parameter, 1001);
        assert_refused(RESULT_OUT_OF_RANGE, OPCODE_SET, parameter, 0x10000 + 100);
    }
}

TEST(get_tells_one_parameter)
{
    execute(OPCODE_SET, STEP_MM, 100);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_GET, STEP_MM, 0));
    TEST_ASSERT_EQUAL_UINT32(100, value_told);
}

TEST(a_report_changes_nothing)
{
    assert_refused(RESULT_DONE, OPCODE_REPORT, 0, 0);
}

TEST(write_sets_the_cells_of_the_mask)
{
    static const uint8_t expected[CELL_COUNT] = {0, 0, SIDE_LEFT, 0, 0, 0, 0, SIDE_RIGHT};

    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_WRITE, UPPER | 1u << 3, (uint32_t)SIDE_RIGHT << 24));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, robot.brain.memory.cell, CELL_COUNT);
}

TEST(what_was_written_is_to_be_stored)
{
    execute(OPCODE_WRITE, UPPER | 1u << 3, (uint32_t)SIDE_RIGHT << 24);
    TEST_ASSERT_TRUE(robot.brain.changed);
}

TEST(writing_what_is_no_side_changes_nothing)
{
    assert_refused(RESULT_OUT_OF_RANGE, OPCODE_WRITE, UPPER | 0xF, 3u << 24);
    assert_refused(RESULT_OUT_OF_RANGE, OPCODE_WRITE, 0x01, SIDE_LEFT);
}

TEST(erase_empties_the_memory)
{
    static const uint8_t expected[CELL_COUNT] = {0};

    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_ERASE, 0, 0));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, robot.brain.memory.cell, CELL_COUNT);
}

TEST(what_was_erased_is_to_be_stored)
{
    execute(OPCODE_ERASE, 0, 0);
    TEST_ASSERT_TRUE(robot.brain.changed);
}

TEST(freeze_stops_learning)
{
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_FREEZE, 1, 0));
    TEST_ASSERT_TRUE(robot.brain.frozen);
}

TEST(freeze_0_lets_it_learn_again)
{
    execute(OPCODE_FREEZE, 1, 0);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_FREEZE, 0, 0));
    TEST_ASSERT_FALSE(robot.brain.frozen);
}

/* Whoever stopped the robot may have carried it elsewhere while no senses came. */
TEST(where_the_wheels_were_before_a_stop_is_forgotten)
{
    TEST_ASSERT_TRUE(robot.motion.referenced);
    execute(OPCODE_STOP, 0, 0);
    TEST_ASSERT_FALSE(robot.motion.referenced);
}

TEST(start_trusts_every_sensor_and_the_wheels_again)
{
    static const struct perception fresh;

    execute(OPCODE_SET, DISTRUST, 1);
    step(FRONT);
    robot.denials = 2;
    robot.turn_denied = true;
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_MEMORY(&fresh, &robot.perception, sizeof fresh);
    TEST_ASSERT_EQUAL_UINT(0, robot.denials);
    TEST_ASSERT_FALSE(robot.turn_denied);
}
