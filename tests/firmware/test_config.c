#include "firmware/config.h"
#include "tests/test.h"

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

TEST(the_defaults_are_the_articles_numbers)
{
    for (unsigned i = 0; i < EXPECTED; i++)
        TEST_ASSERT_EQUAL_UINT8(expected[i].article, config.value[expected[i].parameter]);
}

TEST(both_ends_of_a_range_fit)
{
    for (unsigned i = 0; i < EXPECTED; i++) {
        TEST_ASSERT_TRUE(config_fits(expected[i].parameter, expected[i].min));
        TEST_ASSERT_TRUE(config_fits(expected[i].parameter, expected[i].max));
    }
}

TEST(what_is_beyond_either_end_does_not_fit)
{
    for (unsigned i = 0; i < EXPECTED; i++) {
        TEST_ASSERT_FALSE(config_fits(expected[i].parameter, expected[i].min - 1u));
        TEST_ASSERT_FALSE(config_fits(expected[i].parameter, expected[i].max + 1u));
    }
}

TEST(nothing_beyond_16_bits_fits)
{
    for (unsigned i = 0; i < EXPECTED; i++)
        TEST_ASSERT_FALSE(config_fits(expected[i].parameter, 0x10000u + expected[i].article));
}

TEST(the_defaults_fit)
{
    for (uint8_t p = 0; p < PARAMETER_COUNT; p++)
        TEST_ASSERT_TRUE(config_fits(p, config.value[p]));
}
