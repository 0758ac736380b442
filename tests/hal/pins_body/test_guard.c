#include "hal/pins_body/guard.h"
#include "tests/test.h"

enum { GOOD_MV = 7200, HARD = 30000 };

static struct guard guard;
static struct guard_look now;

void setUp(void)
{
    guard = (struct guard){.known = false};
    now = (struct guard_look){.battery_mv = GOOD_MV};
}

/* Looks in which the left wheel counts so far each time; true if the last of them stops the wheels. */
static bool look(unsigned looks, int count)
{
    bool stops = false;

    for (unsigned i = 0; i < looks; i++) {
        now.counts[0] = (uint16_t)(now.counts[0] + count);
        stops = guard_stops(&guard, &now);
    }
    return stops;
}

TEST(nothing_is_wrong_with_a_wheel_that_turns_as_it_is_pushed)
{
    guard.duty[0] = HARD;
    TEST_ASSERT_FALSE(look(1000, 10));
    guard.duty[0] = -HARD;
    TEST_ASSERT_FALSE(look(1000, -10));
    guard.duty[0] = 0;
    TEST_ASSERT_FALSE(look(1000, -10));
    TEST_ASSERT_FALSE(guard_forbids(&guard));
}

TEST(an_encoder_that_counts_against_its_motor_is_found_in_a_fifth_of_a_second)
{
    TEST_ASSERT_FALSE(look(1, 0));
    guard.duty[0] = HARD;
    TEST_ASSERT_FALSE(look(GUARD_BEATS - 1, -10));
    TEST_ASSERT_TRUE(look(1, -10));
    TEST_ASSERT_TRUE(guard_forbids(&guard));
    TEST_ASSERT_TRUE(look(1, 10));
}

TEST(a_motor_that_is_reversed_rolls_on_for_a_while)
{
    TEST_ASSERT_FALSE(look(1, 0));
    guard.duty[0] = -HARD;
    TEST_ASSERT_FALSE(look(GUARD_BEATS - 1, 10));
    TEST_ASSERT_FALSE(look(1, -1));
    TEST_ASSERT_FALSE(look(GUARD_BEATS - 1, 10));
    TEST_ASSERT_FALSE(guard_forbids(&guard));
}

TEST(a_weak_push_tells_nothing)
{
    guard.duty[0] = GUARD_WRONG_DUTY;
    TEST_ASSERT_FALSE(look(1000, -10));
    guard.duty[0] = -GUARD_WRONG_DUTY;
    TEST_ASSERT_FALSE(look(1000, 10));
}

TEST(a_bump_stops_the_wheels_once)
{
    now.bumped = true;
    TEST_ASSERT_TRUE(look(1, 0));
    TEST_ASSERT_FALSE(look(10, 0));
    now.bumped = false;
    TEST_ASSERT_FALSE(look(1, 0));
    now.bumped = true;
    TEST_ASSERT_TRUE(look(1, 0));
    TEST_ASSERT_FALSE(guard_forbids(&guard));
}

TEST(an_empty_battery_stops_the_wheels_for_good_and_a_dip_does_not)
{
    now.battery_mv = GUARD_BATTERY_MV - 1;
    TEST_ASSERT_FALSE(look(GUARD_BEATS - 1, 0));
    now.battery_mv = GUARD_BATTERY_MV;
    TEST_ASSERT_FALSE(look(1, 0));
    now.battery_mv = GUARD_BATTERY_MV - 1;
    TEST_ASSERT_FALSE(look(GUARD_BEATS - 1, 0));
    TEST_ASSERT_TRUE(look(1, 0));
    now.battery_mv = GOOD_MV;
    TEST_ASSERT_TRUE(look(1, 0));
}

TEST(a_bridge_that_failed_stops_the_wheels_for_good)
{
    now.failed = true;
    TEST_ASSERT_TRUE(look(1, 0));
    now.failed = false;
    TEST_ASSERT_TRUE(guard_forbids(&guard));
}

TEST(the_right_wheel_is_watched_too)
{
    guard.duty[1] = HARD;
    for (unsigned i = 0; i <= GUARD_BEATS; i++) {
        now.counts[1] = (uint16_t)(now.counts[1] - 10);
        (void)guard_stops(&guard, &now);
    }
    TEST_ASSERT_TRUE(guard_forbids(&guard));
}
