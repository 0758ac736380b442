#include "firmware/brain.h"
#include "firmware/feel_memory.h"

#include <unity.h>

enum { CLEAR = 0, FRONT = FEEL_FRONT, ALL_THREE = 14 };

static struct brain brain;
static struct config config;

void setUp(void)
{
    brain = (struct brain){.frozen = false};
    config_reset(&config);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_FIVE, 1));
}

void tearDown(void) {}

static struct action next(uint8_t feel)
{
    const struct senses senses = {.feel = feel};

    return brain_next(&brain, &config, &senses);
}

static void test_the_side_sensors_tell_readings_apart(void)
{
    next(ALL_THREE);
    next(CLEAR);   /* it helped */
    next(CLEAR);   /* looks around */
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(ALL_THREE).reason);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE | FEEL_LEFT).reason);
}

static void test_the_side_sensors_alone_are_not_in_the_way(void)
{
    TEST_ASSERT_EQUAL(REASON_WANDER, next(FEEL_LEFT | FEEL_RIGHT).reason);
}

static void test_the_side_sensors_do_not_judge_a_trial(void)
{
    next(FRONT | FEEL_LEFT | FEEL_RIGHT);
    next(FRONT);
    TEST_ASSERT_FALSE(brain.changed);
}

static void test_boredom_can_strike_again(void)
{
    feel_memory_learn(&brain.memory, FRONT, SIDE_LEFT);
    for (unsigned i = 1; i <= 22; i++)
        TEST_ASSERT_EQUAL(i % 11 == 0 ? REASON_BOREDOM : REASON_REMEMBERED, next(FRONT).reason);
}

static void test_a_frozen_brain_learns_nothing(void)
{
    brain.frozen = true;
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_FALSE(brain.changed);
    TEST_ASSERT_EACH_EQUAL_HEX8(0, brain.memory.cell, CELL_COUNT);
}

static void test_a_trial_that_helped_is_a_change(void)
{
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_TRUE(brain.changed);
    TEST_ASSERT_TRUE(brain.learns);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_side_sensors_tell_readings_apart);
    RUN_TEST(test_the_side_sensors_alone_are_not_in_the_way);
    RUN_TEST(test_the_side_sensors_do_not_judge_a_trial);
    RUN_TEST(test_boredom_can_strike_again);
    RUN_TEST(test_a_frozen_brain_learns_nothing);
    RUN_TEST(test_a_trial_that_helped_is_a_change);
    return UNITY_END();
}
