#include "firmware/motion/wheels.h"

#include "tests/test.h"

static struct config config;

void setUp(void)
{
    config_reset(&config);
}

TEST(a_degree_is_a_degree_of_the_wheel_track)
{
    TEST_ASSERT_EQUAL_UINT32(457528, wheels_turn_per_degree(&config));   /* 160 mm * pi / 180 */
}

TEST(the_fastest_is_the_greater_of_both_speeds)
{
    TEST_ASSERT_EQUAL_UINT32(251, wheels_turning_mm_s(&config));
    TEST_ASSERT_EQUAL_UINT32(251, wheels_fastest_mm_s(&config));
    config.value[TURN_SPEED_DEG_S] = 30;
    TEST_ASSERT_EQUAL_UINT32(200, wheels_fastest_mm_s(&config));
}

TEST(counts_of_a_tick_are_rounded)
{
    TEST_ASSERT_EQUAL_UINT32(80, wheels_counts_at(200, &config));
    TEST_ASSERT_EQUAL_UINT32(100, wheels_counts_at(251, &config));
    TEST_ASSERT_EQUAL_UINT32(101, wheels_counts_at(252, &config));
}

TEST(an_odometer_wraps)
{
    TEST_ASSERT_EQUAL_INT32(2, wheels_counts_between(4095, 1));
    TEST_ASSERT_EQUAL_INT32(-2, wheels_counts_between(1, 4095));
    TEST_ASSERT_EQUAL_INT32(2047, wheels_counts_between(0, 2047));
    TEST_ASSERT_EQUAL_INT32(-2048, wheels_counts_between(0, 2048));
}

TEST(a_limit_holds_either_way)
{
    TEST_ASSERT_EQUAL_INT32(5, wheels_limited(6, 5));
    TEST_ASSERT_EQUAL_INT32(-5, wheels_limited(-6, 5));
    TEST_ASSERT_EQUAL_INT32(-4, wheels_limited(-4, 5));
    TEST_ASSERT_EQUAL_UINT32(7, wheels_magnitude(-7));
}
