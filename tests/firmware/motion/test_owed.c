/* What wheels still owe, whatever their lag, delay and gain. */
#include "firmware/motion/owed.h"

#include <math.h>

#include "tests/test.h"

enum { FULL = 100, HALF_A_DEGREE = 14 };   /* of both wheels in a tick, turning */

static struct owed owed;

void setUp(void)
{
    owed = (struct owed){.counts = 0};
}

/* Wheels told FULL for some ticks and then nothing. Returns what they have rolled of it. */
static double follow(double lag_ticks, unsigned delay, double gain, unsigned ticks)
{
    double speed = 0.0, way = 0.0, seen = 0.0;

    for (unsigned i = 0; i < ticks; i++) {
        double aim = i >= delay ? gain * FULL : 0.0;
        double part = lag_ticks > 0.0 ? lag_ticks * (1.0 - exp(-1.0 / lag_ticks)) : 0.0;
        double rolled = aim + (speed - aim) * part;

        owed_tell(&owed, FULL);
        speed = lag_ticks > 0.0 ? aim + (speed - aim) * exp(-1.0 / lag_ticks) : aim;
        way += rolled;
        owed_settle(&owed, (int32_t)(floor(way) - floor(seen)), 1);
        seen = way;
    }
    return way;
}

TEST(wheels_owe_what_they_were_told_and_have_not_rolled)
{
    for (unsigned lag = 0; lag <= 5; lag++)
        for (unsigned delay = 0; delay <= 2; delay++)
            for (unsigned ticks = 1; ticks <= 40; ticks++) {
                double way;

                setUp();
                way = follow(lag, delay, 1.0, ticks);
                TEST_ASSERT_INT_WITHIN(2 * HALF_A_DEGREE, (int)(FULL * ticks - way), owed.counts);
            }
}

/* What is missing at a steady speed will never be rolled. */
TEST(slower_wheels_do_not_owe_more_and_more)
{
    (void)follow(0.0, 0, 0.8, 60);
    TEST_ASSERT_INT_WITHIN(FULL / 2, 0, owed.counts);
}

TEST(faster_wheels_owe_nothing_back)
{
    (void)follow(0.0, 0, 1.2, 60);
    TEST_ASSERT_EQUAL_INT32(0, owed_counts(&owed));
}

TEST(wheels_that_stand_owe_the_last_two_orders_at_most)
{
    for (unsigned i = 0; i < 10; i++) {
        owed_tell(&owed, FULL);
        owed_settle(&owed, 0, 1);
    }
    TEST_ASSERT_EQUAL_INT32(2 * FULL, owed_counts(&owed));
    for (unsigned i = 0; i < 2; i++) {
        owed_tell(&owed, 0);
        owed_settle(&owed, 0, 1);
    }
    TEST_ASSERT_EQUAL_INT32(0, owed_counts(&owed));
}

TEST(what_rounding_adds_up_to_is_not_owed)
{
    owed.counts = 5;
    TEST_ASSERT_EQUAL_INT32(0, owed_counts(&owed));
    owed.counts = -6;
    TEST_ASSERT_EQUAL_INT32(-6, owed_counts(&owed));
}

TEST(wheels_gone_mad_overflow_nothing)
{
    for (int i = 0; i < 100; i++) {
        owed_tell(&owed, i % 3 ? 6400 : -6400);
        owed_settle(&owed, i % 2 ? 4095 : -4096, 5);
        TEST_ASSERT_INT_WITHIN(16000, 0, owed.counts);
    }
}
