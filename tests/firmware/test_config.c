#include "firmware/config.h"

#include <unity.h>

/* Those that the article names, or implies. */
static const struct {
    uint8_t parameter, min, article, max;
} expected[] = {
    {TURN_DEG, 1, 10, 180},         {TRIAL_DEG, 1, 45, 180},        {STEP_MM, 1, 12, 250},
    {LOOK_MIN_DEG, 1, 2, 90},       {LOOK_CHOICES, 1, 10, 90},      {REACH_MM, 1, 150, 250},
    {BOREDOM_LIMIT, 1, 10, 254},    {BOREDOM_MIN_DEG, 1, 150, 180}, {BOREDOM_CHOICES, 1, 60, 180},
    {SPEED_MM_S, 20, 200, 250},     {TURN_SPEED_DEG_S, 30, 180, 250},
    {WHEEL_TRACK_MM, 80, 160, 250}, {TICK_MS, 10, 20, 100},
    {FILTER, 0, 0, 1},              {DISTRUST, 0, 0, 255},
};

enum { EXPECTED = sizeof expected / sizeof expected[0] };

static struct config config;

void setUp(void)
{
    config_reset(&config);
}

void tearDown(void) {}

static void test_the_defaults_are_the_articles_numbers(void)
{
    for (unsigned i = 0; i < EXPECTED; i++)
        TEST_ASSERT_EQUAL_UINT8(expected[i].article, config.value[expected[i].parameter]);
}

static void test_both_ends_of_a_range_fit(void)
{
    for (unsigned i = 0; i < EXPECTED; i++) {
        TEST_ASSERT_TRUE(config_fits(expected[i].parameter, expected[i].min));
        TEST_ASSERT_TRUE(config_fits(expected[i].parameter, expected[i].max));
    }
}

static void test_what_is_beyond_either_end_does_not_fit(void)
{
    for (unsigned i = 0; i < EXPECTED; i++) {
        TEST_ASSERT_FALSE(config_fits(expected[i].parameter, expected[i].min - 1u));
        TEST_ASSERT_FALSE(config_fits(expected[i].parameter, expected[i].max + 1u));
    }
}

static void test_nothing_beyond_16_bits_fits(void)
{
    for (unsigned i = 0; i < EXPECTED; i++)
        TEST_ASSERT_FALSE(config_fits(expected[i].parameter, 0x10000u + expected[i].article));
}

static void test_the_defaults_fit(void)
{
    for (uint8_t p = 0; p < PARAMETER_COUNT; p++)
        TEST_ASSERT_TRUE(config_fits(p, config.value[p]));
}

static void test_setting_a_parameter_leaves_the_others(void)
{
    for (unsigned i = 0; i < EXPECTED; i++) {
        struct config before = config;

        config_set(&config, expected[i].parameter, expected[i].max);
        before.value[expected[i].parameter] = expected[i].max;
        TEST_ASSERT_EQUAL_MEMORY(&before, &config, sizeof config);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_defaults_are_the_articles_numbers);
    RUN_TEST(test_both_ends_of_a_range_fit);
    RUN_TEST(test_what_is_beyond_either_end_does_not_fit);
    RUN_TEST(test_nothing_beyond_16_bits_fits);
    RUN_TEST(test_the_defaults_fit);
    RUN_TEST(test_setting_a_parameter_leaves_the_others);
    return UNITY_END();
}
