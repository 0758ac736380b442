#include "firmware/brain.h"

#include <unity.h>

enum { FRONT = FEEL_FRONT, ALL_THREE = 14 };
enum { PATTERN_FRONT = 2, PATTERN_ALL_THREE = 7 };

static struct brain brain;
static struct config config;

void setUp(void)
{
    brain = (struct brain){.frozen = false};
    config_reset(&config);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_RECHECK, 1));
}

void tearDown(void) {}

static struct action next(uint8_t feel)
{
    const struct senses senses = {.feel = feel};

    return brain_next(&brain, &config, &senses);
}

static void remembered_turns(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
}

static void test_a_remembered_turn_that_frees_no_sensor_is_forgotten(void)
{
    memory_learn(&brain.memory, PATTERN_FRONT, SIDE_LEFT);
    next(FRONT);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_TRUE(brain.changed);
}

static void test_one_that_frees_a_sensor_is_kept(void)
{
    memory_learn(&brain.memory, PATTERN_ALL_THREE, SIDE_LEFT);
    next(ALL_THREE);
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_FALSE(brain.changed);
}

static void test_the_turn_before_the_about_face_is_checked_too(void)
{
    memory_learn(&brain.memory, PATTERN_FRONT, SIDE_LEFT);
    brain.repeat_count = 9;
    next(FRONT);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

static void test_a_frozen_brain_forgets_nothing(void)
{
    memory_learn(&brain.memory, PATTERN_FRONT, SIDE_LEFT);
    brain.frozen = true;
    remembered_turns(3);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_remembered_turn_that_frees_no_sensor_is_forgotten);
    RUN_TEST(test_one_that_frees_a_sensor_is_kept);
    RUN_TEST(test_the_turn_before_the_about_face_is_checked_too);
    RUN_TEST(test_a_frozen_brain_forgets_nothing);
    return UNITY_END();
}
