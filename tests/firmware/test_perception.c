#include "tests/test.h"
#include "firmware/pattern.h"
#include "firmware/perception.h"
#include "firmware/robot.h"

enum { RIGHT_BIT = 1, FRONT_RIGHT_BIT = 2, FRONT_BIT = 4, FRONT_LEFT_BIT = 8, LEFT_BIT = 16 };

TEST(front_sensors_have_bits_0_to_2)
{
    TEST_ASSERT_EQUAL_UINT8(1, pattern_of(FRONT_RIGHT_BIT));
    TEST_ASSERT_EQUAL_UINT8(2, pattern_of(FRONT_BIT));
    TEST_ASSERT_EQUAL_UINT8(4, pattern_of(FRONT_LEFT_BIT));
}

TEST(side_sensors_and_unused_bits_change_no_pattern)
{
    for (unsigned front = 0; front < 8; front++) {
        TEST_ASSERT_EQUAL_UINT8(front, pattern_of((uint8_t)(front << 1 | RIGHT_BIT | LEFT_BIT)));
        TEST_ASSERT_EQUAL_UINT8(front, pattern_of((uint8_t)(front << 1 | 0xE0)));
    }
}

TEST(pattern_count_is_the_number_of_triggered_sensors)
{
    static const uint8_t counts[8] = {0, 1, 1, 2, 1, 2, 2, 3};

    for (uint8_t pattern = 0; pattern < 8; pattern++)
        TEST_ASSERT_EQUAL_UINT8(counts[pattern], pattern_count(pattern));
}

enum { FRONT = FEEL_FRONT, LEFT = FEEL_LEFT, ALL = 31, LIMIT = 32 };

static struct perception perception;
static struct config config;

BEFORE_EACH(perception)
{
    perception_start(&perception);
    config_reset(&config);
}

static uint8_t filtered(uint8_t feel)
{
    return perception_filter(&perception, &config, feel);
}

static void decide(uint8_t feel, unsigned times)
{
    for (unsigned i = 0; i < times; i++)
        perception_decide(&perception, &config, feel);
}

static uint8_t believed(uint8_t feel)
{
    return perception_believed(&perception, &config, feel);
}

TEST(perception_believes_all_sensors_by_default)
{
    decide(ALL, 300);
    for (uint8_t feel = 0; feel <= ALL; feel++)
        TEST_ASSERT_EQUAL_HEX8(feel, believed(filtered(feel)));
}

TEST(filter_takes_the_majority_of_three_ticks)
{
    config.value[FILTER] = 1;
    for (unsigned cases = 0; cases < 8; cases++) {
        const unsigned bit[] = {cases & 1u, cases >> 1 & 1u, cases >> 2};
        unsigned sum = bit[0] + bit[1] + bit[2];

        perception_start(&perception);
        filtered((uint8_t)(FRONT * bit[0] | LEFT * (1u - bit[0])));
        filtered((uint8_t)(FRONT * bit[1] | LEFT * (1u - bit[1])));
        TEST_ASSERT_EQUAL_HEX8(sum >= 2 ? FRONT : LEFT,
                               filtered((uint8_t)(FRONT * bit[2] | LEFT * (1u - bit[2]))));
    }
}

TEST(sensor_is_distrusted_after_the_limit_of_decisions_in_a_row)
{
    config.value[DISTRUST] = LIMIT;
    decide(FRONT, LIMIT - 1);
    TEST_ASSERT_EQUAL_HEX8(FRONT, believed(FRONT));
    decide(FRONT, 1);
    TEST_ASSERT_EQUAL_HEX8(0, believed(FRONT));
}

TEST(other_sensors_are_still_believed)
{
    config.value[DISTRUST] = LIMIT;
    decide(FRONT, LIMIT);
    TEST_ASSERT_EQUAL_HEX8(ALL & ~FRONT, believed(ALL));
}

TEST(stuck_sensor_stays_distrusted)
{
    config.value[DISTRUST] = 255;
    decide(FRONT, 1000);
    TEST_ASSERT_EQUAL_HEX8(0, believed(FRONT));
}

TEST(quiet_decision_restores_trust)
{
    config.value[DISTRUST] = LIMIT;
    decide(FRONT, LIMIT);
    decide(0, 1);
    TEST_ASSERT_EQUAL_HEX8(FRONT, believed(FRONT));
}

/* The whole robot, on wheels that obey. */

static struct robot robot;
static struct senses senses;

static void start(uint8_t parameter, uint8_t value)
{
    const struct command command = {.opcode = OPCODE_START, .which = PROFILE_ARTICLE, .value = 1};
    uint32_t answer;

    robot_init(&robot, 0);
    TEST_ASSERT_EQUAL(RESULT_DONE, robot_execute(&robot, &command, &answer));
    robot.config.value[parameter] = value;
}

static uint16_t rolled(uint16_t odometer, int speed_mm_s)
{
    int counts = speed_mm_s * ODOMETER_COUNTS_PER_MM * config.value[TICK_MS] / 1000;

    return (uint16_t)((odometer + counts) & (ODOMETER_SPAN - 1));
}

static struct drive step(uint8_t feel)
{
    struct drive drive;

    senses.feel = feel;
    robot_step(&robot, &senses, &drive);
    senses.tick++;
    senses.odometer_left = rolled(senses.odometer_left, drive.left_mm_s);
    senses.odometer_right = rolled(senses.odometer_right, drive.right_mm_s);
    return drive;
}

TEST(filter_ignores_a_glitch_of_one_tick_in_a_step)
{
    start(FILTER, 1);
    TEST_ASSERT_EQUAL(REASON_WANDER, step(0).reason);
    TEST_ASSERT_EQUAL(REASON_WANDER, step(FRONT).reason);
    TEST_ASSERT_EQUAL(200, step(0).left_mm_s);
}

TEST(glitch_of_one_tick_ends_a_step_without_filter)
{
    start(FILTER, 0);
    TEST_ASSERT_EQUAL(REASON_WANDER, step(0).reason);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, step(FRONT).reason);
}

/* Returns for how many ticks the robot rests at the end of a trial. */
static unsigned ticks_at_rest_in_a_trial(void)
{
    unsigned rested = 0;

    while (step(FRONT).reason != REASON_TRIAL)
        ;
    for (uint8_t action = robot.action;;) {
        const struct drive drive = step(FRONT);

        if (robot.action != action)
            return rested;
        rested += drive.left_mm_s == 0;
    }
}

TEST(filtered_trial_is_judged_after_two_ticks_at_rest)
{
    start(FILTER, 1);
    TEST_ASSERT_EQUAL_UINT(2, ticks_at_rest_in_a_trial());
}

TEST(unfiltered_trial_is_judged_at_once)
{
    start(FILTER, 0);
    TEST_ASSERT_EQUAL_UINT(0, ticks_at_rest_in_a_trial());
}

static unsigned ticks_until_next_step(void)
{
    unsigned ticks = 0;

    while (step(FRONT).reason != REASON_WANDER)
        TEST_ASSERT_LESS_THAN_UINT(20000, ticks++);
    return ticks;
}

TEST(stuck_sensor_does_not_block_a_robot_that_distrusts_it)
{
    start(DISTRUST, LIMIT);
    ticks_until_next_step();
}

TEST(start_resets_the_distrust_of_sensors)
{
    start(DISTRUST, LIMIT);
    ticks_until_next_step();
    start(DISTRUST, LIMIT);
    TEST_ASSERT_EQUAL(REASON_TRIAL, step(FRONT).reason);
}

TEST(decisions_are_not_counted_while_distrust_is_off)
{
    decide(ALL, 300);
    config.value[DISTRUST] = 1;
    TEST_ASSERT_EQUAL_HEX8(ALL, believed(ALL));
}

TEST(limit_of_one_distrusts_after_the_first_decision)
{
    config.value[DISTRUST] = 1;
    decide(FRONT, 1);
    TEST_ASSERT_EQUAL_HEX8(0, believed(FRONT));
}

TEST(every_sensor_can_be_distrusted)
{
    config.value[DISTRUST] = LIMIT;
    decide(ALL, LIMIT + 5);
    TEST_ASSERT_EQUAL_HEX8(0, believed(ALL));
}

TEST(quiet_decision_resets_the_count)
{
    config.value[DISTRUST] = LIMIT;
    decide(FRONT, LIMIT);
    decide(0, 1);
    decide(FRONT, LIMIT - 1);
    TEST_ASSERT_EQUAL_HEX8(FRONT, believed(FRONT));
}

TEST(perception_start_trusts_every_sensor)
{
    config.value[DISTRUST] = LIMIT;
    decide(ALL, LIMIT);
    perception_start(&perception);
    TEST_ASSERT_EQUAL_HEX8(ALL, believed(ALL));
}
