#include "tests/test.h"
#include "firmware/config.h"
#include "firmware/robot.h"

/* The parameters whose defaults the article gives or implies. */
static const struct {
    uint8_t parameter, min, article, max;
} named[] = {
    {TURN_DEG, 1, 10, 180},         {TRIAL_DEG, 1, 45, 180},        {STEP_MM, 1, 12, 250},
    {LOOK_MIN_DEG, 1, 2, 90},       {LOOK_CHOICES, 1, 10, 90},      {REACH_MM, 1, 150, 250},
    {BOREDOM_LIMIT, 1, 10, 254},    {BOREDOM_MIN_DEG, 1, 150, 180}, {BOREDOM_CHOICES, 1, 60, 180},
    {SPEED_MM_S, 20, 200, 250},     {TURN_SPEED_DEG_S, 30, 180, 250},
    {WHEEL_TRACK_MM, 80, 160, 250}, {TICK_MS, 10, 20, 100},
    {FILTER, 0, 0, 1},              {DISTRUST, 0, 0, 255},
};

enum { NAMED = sizeof named / sizeof named[0] };

static struct config config;

BEFORE_EACH(config)
{
    config_reset(&config);
}

TEST(defaults_are_the_figures_of_the_article)
{
    for (unsigned i = 0; i < NAMED; i++)
        TEST_ASSERT_EQUAL_UINT8(named[i].article, config.value[named[i].parameter]);
}

TEST(limits_of_a_range_fit)
{
    for (unsigned i = 0; i < NAMED; i++) {
        TEST_ASSERT_TRUE(config_fits(named[i].parameter, named[i].min));
        TEST_ASSERT_TRUE(config_fits(named[i].parameter, named[i].max));
    }
}

TEST(value_beyond_its_range_does_not_fit)
{
    for (unsigned i = 0; i < NAMED; i++) {
        TEST_ASSERT_FALSE(config_fits(named[i].parameter, named[i].min - 1u));
        TEST_ASSERT_FALSE(config_fits(named[i].parameter, named[i].max + 1u));
    }
}

TEST(value_beyond_16_bits_does_not_fit)
{
    for (unsigned i = 0; i < NAMED; i++)
        TEST_ASSERT_FALSE(config_fits(named[i].parameter, 0x10000u + named[i].article));
}

TEST(defaults_fit_their_ranges)
{
    for (uint8_t p = 0; p < PARAMETER_COUNT; p++)
        TEST_ASSERT_TRUE(config_fits(p, config.value[p]));
}

enum { UPPER = 16 /* half of the memory */, CLEAR = 0, FRONT = 4, PATTERN_FRONT = 2 };

static struct robot robot;

static uint32_t answer_value;

static enum result execute(enum opcode opcode, unsigned which, uint32_t value)
{
    const struct command command = {.opcode = opcode, .which = (uint8_t)which, .value = value};

    return robot_execute(&robot, &command, &answer_value);
}

static struct drive step(uint8_t feel)
{
    const struct senses senses = {.feel = feel};
    struct drive drive;

    robot_step(&robot, &senses, &drive);
    return drive;
}

/* A running robot, with a lesson learned and a turn under way. */
BEFORE_EACH(commands)
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

TEST(unknown_command_changes_no_state)
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

TEST(resume_continues_the_interrupted_turn)
{
    const struct drive before = step(FRONT);

    execute(OPCODE_STOP, 0, 0);
    step(FRONT);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_RESUME, 0, 0));
    TEST_ASSERT_EQUAL_INT16(before.left_mm_s, step(FRONT).left_mm_s);
}

/* Whoever stopped the robot may have carried it elsewhere. */
TEST(resume_ignores_motion_while_stopped)
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

TEST(start_command_keeps_the_memory)
{
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&robot.brain.memory, PATTERN_FRONT));
}

TEST(start_answers_whether_the_behaviour_wants_ranges)
{
    answer_value = UINT32_MAX;
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_UINT32(0, answer_value);
    execute(OPCODE_START, PROFILE_DISTANCE, 1);
    TEST_ASSERT_EQUAL_UINT32(ANSWER_WANTS_RANGES, answer_value);
}

TEST(start_of_a_stopped_robot_restarts_the_second)
{
    robot.part_ms = 300;
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_UINT(300, robot.part_ms);
    execute(OPCODE_STOP, 0, 0);
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_UINT(0, robot.part_ms);
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

TEST(start_ends_freezing)
{
    execute(OPCODE_FREEZE, 1, 0);
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_FALSE(robot.brain.frozen);
}

TEST(start_discards_the_current_turn)
{
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL(REASON_WANDER, step(CLEAR).reason);
}

TEST(start_resets_the_action_number)
{
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_UINT8(1, step(CLEAR).action);
}

TEST(start_command_with_an_unknown_profile_changes_no_state)
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

TEST(unknown_parameter_changes_no_state)
{
    for (unsigned parameter = PARAMETER_COUNT; parameter <= UINT8_MAX; parameter++) {
        assert_refused(RESULT_UNKNOWN_PARAMETER, OPCODE_SET, parameter, 10);
        assert_refused(RESULT_UNKNOWN_PARAMETER, OPCODE_GET, parameter, 0);
    }
}

TEST(value_out_of_range_changes_no_state)
{
    for (unsigned parameter = 0; parameter < PARAMETER_COUNT; parameter++) {
        if (!config_fits((uint8_t)parameter, 0))
            assert_refused(RESULT_OUT_OF_RANGE, OPCODE_SET, parameter, 0);
        assert_refused(RESULT_OUT_OF_RANGE, OPCODE_SET, parameter, 1001);
        assert_refused(RESULT_OUT_OF_RANGE, OPCODE_SET, parameter, 0x10000 + 100);
    }
}

TEST(get_returns_one_parameter)
{
    execute(OPCODE_SET, STEP_MM, 100);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_GET, STEP_MM, 0));
    TEST_ASSERT_EQUAL_UINT32(100, answer_value);
}

TEST(report_command_changes_no_state)
{
    assert_refused(RESULT_DONE, OPCODE_REPORT, 0, 0);
}

TEST(write_sets_the_cells_of_the_mask)
{
    static const uint8_t expected[CELL_COUNT] = {0, 0, SIDE_LEFT, 0, 0, 0, 0, SIDE_RIGHT};

    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_WRITE, UPPER | 1u << 3, (uint32_t)SIDE_RIGHT << 24));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, robot.brain.memory.cell, CELL_COUNT);
}

TEST(write_marks_the_memory_as_changed)
{
    execute(OPCODE_WRITE, UPPER | 1u << 3, (uint32_t)SIDE_RIGHT << 24);
    TEST_ASSERT_TRUE(robot.brain.changed);
}

TEST(write_command_with_an_invalid_side_changes_no_state)
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

TEST(erase_marks_the_memory_as_changed)
{
    execute(OPCODE_ERASE, 0, 0);
    TEST_ASSERT_TRUE(robot.brain.changed);
}

TEST(freeze_stops_learning)
{
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_FREEZE, 1, 0));
    TEST_ASSERT_TRUE(robot.brain.frozen);
}

TEST(freeze_0_resumes_learning)
{
    execute(OPCODE_FREEZE, 1, 0);
    TEST_ASSERT_EQUAL(RESULT_DONE, execute(OPCODE_FREEZE, 0, 0));
    TEST_ASSERT_FALSE(robot.brain.frozen);
}

/* Whoever stopped the robot may have carried it elsewhere while no senses came. */
TEST(stop_discards_the_odometer_reference)
{
    TEST_ASSERT_TRUE(robot.motion.referenced);
    execute(OPCODE_STOP, 0, 0);
    TEST_ASSERT_FALSE(robot.motion.referenced);
}

TEST(start_resets_distrust_caution_and_denials)
{
    static const struct perception fresh;
    static const struct caution at_ease;

    execute(OPCODE_SET, DISTRUST, 1);
    step(FRONT);
    robot.caution.doing = 1;
    robot.denials = 2;
    robot.turn_denied = true;
    execute(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL_MEMORY(&fresh, &robot.perception, sizeof fresh);
    TEST_ASSERT_EQUAL_MEMORY(&at_ease, &robot.caution, sizeof at_ease);
    TEST_ASSERT_EQUAL_UINT(0, robot.denials);
    TEST_ASSERT_FALSE(robot.turn_denied);
}
