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

/* What wheels owe after a tick, or several, in which they rolled this far. */
static int after(struct owed before, int rolled, unsigned ticks)
{
    owed_settle(&before, rolled, ticks);
    TEST_ASSERT_EQUAL_INT16(rolled, before.rolled);
    return before.counts;
}

static void assert_either_way(int expected, struct owed before, int rolled)
{
    struct owed back = {.counts = (int16_t)-before.counts, .rolled = (int16_t)-before.rolled, .same = before.same};

    back.told[0] = (int16_t)-before.told[0];
    back.told[1] = (int16_t)-before.told[1];
    TEST_ASSERT_EQUAL_INT(expected, after(before, rolled, 1));
    TEST_ASSERT_EQUAL_INT(-expected, after(back, -rolled, 1));
}

TEST(a_command_is_owed_until_it_may_have_arrived)
{
    assert_either_way(40 + 40, (struct owed){.counts = 40, .rolled = 58, .told = {100, 100}, .same = 1}, 60);
    assert_either_way(40 + 12, (struct owed){.counts = 40, .rolled = 58, .told = {100, 100}, .same = 2}, 60);
    assert_either_way(40 - 60, (struct owed){.counts = 40, .rolled = 60, .told = {0, -100}, .same = 9}, 60);
}

TEST(wheels_that_hardly_rolled_have_just_begun)
{
    assert_either_way(95, (struct owed){.rolled = 3, .told = {100, 100}, .same = 9}, 5);
    assert_either_way(6, (struct owed){.rolled = 4, .told = {100, 100}, .same = 9}, 5);
}

TEST(what_an_acceleration_gathers_is_owed_up_to_what_is_missing)
{
    assert_either_way(10, (struct owed){.rolled = 60, .told = {100, 100}, .same = 9}, 90);
    assert_either_way(60 - 50, (struct owed){.counts = 60, .rolled = 60, .told = {100, 100}, .same = 9}, 50);
}

TEST(what_rounding_seems_to_gather_is_not_owed)
{
    assert_either_way(60, (struct owed){.counts = 60, .rolled = 98, .told = {100, 100}, .same = 9}, 97);
    assert_either_way(60 - 4, (struct owed){.counts = 60, .rolled = 97, .told = {100, 100}, .same = 9}, 96);
    assert_either_way(60, (struct owed){.counts = 60, .rolled = 101, .told = {100, 100}, .same = 9}, 102);
    assert_either_way(60 + 1, (struct owed){.counts = 60, .rolled = 98, .told = {100, 100}, .same = 9}, 99);
    assert_either_way(60, (struct owed){.counts = 60, .rolled = 102, .told = {100, 100}, .same = 9}, 102);
}

TEST(no_more_is_owed_than_wheels_at_that_speed_coast)
{
    assert_either_way(60, (struct owed){.counts = 100, .rolled = 10}, 10);
    assert_either_way(72, (struct owed){.counts = 100, .rolled = 6}, 10);
    assert_either_way(48, (struct owed){.counts = 100, .rolled = 14}, 10);
    assert_either_way(0, (struct owed){.counts = 100, .rolled = 14}, 2);
    assert_either_way(0, (struct owed){.counts = 100, .rolled = 20}, 0);
    assert_either_way(0, (struct owed){.counts = 100}, 0);
    assert_either_way(0, (struct owed){.counts = -100, .rolled = 10}, 10);
    assert_either_way(7 - 1, (struct owed){.counts = 7, .rolled = 1}, 1);
    assert_either_way(0, (struct owed){.counts = 100, .rolled = 100}, -1);
    assert_either_way(0, (struct owed){.counts = 100, .rolled = -100}, -1);
    assert_either_way(0, (struct owed){.counts = 100, .rolled = -10}, 0);
}

TEST(no_more_is_owed_than_the_last_two_commands_and_what_wheels_coast)
{
    assert_either_way(30, (struct owed){.counts = 100, .told = {30, 0}}, 0);
    assert_either_way(30, (struct owed){.counts = 100, .told = {0, 30}}, 0);
    assert_either_way(60, (struct owed){.counts = 100, .told = {30, 30}}, 0);
    assert_either_way(30, (struct owed){.counts = 100, .told = {30, -20}}, 0);
    assert_either_way(-20, (struct owed){.counts = -100, .told = {30, -20}}, 0);
    assert_either_way(30 + 20 + 60, (struct owed){.counts = 200, .rolled = 10, .told = {30, 20}}, 10);
    assert_either_way(30, (struct owed){.told = {30, 20}}, 0);
    assert_either_way(1, (struct owed){.counts = 9, .told = {0, 1}}, 0);
    assert_either_way(1, (struct owed){.counts = 9, .told = {1, 0}}, 0);
}

TEST(a_command_is_owed_for_each_of_several_ticks)
{
    TEST_ASSERT_EQUAL_INT(60 - 10, after((struct owed){.told = {30, 30}}, 10, 2));
    TEST_ASSERT_EQUAL_INT(-60 + 10, after((struct owed){.told = {-30, -30}}, -10, 2));
}

TEST(what_is_owed_stays_within_bounds)
{
    assert_either_way(16000, (struct owed){.counts = 15990, .told = {9000, 9000}}, 0);
}

TEST(equal_commands_in_a_row_are_counted_up_to_255)
{
    owed_tell(&owed, 7);
    TEST_ASSERT_EQUAL_UINT8(0, owed.same);
    for (unsigned i = 1; i <= 300; i++) {
        owed_tell(&owed, 7);
        TEST_ASSERT_EQUAL_UINT8(i < 255 ? i : 255, owed.same);
    }
    owed_tell(&owed, 8);
    TEST_ASSERT_EQUAL_UINT8(0, owed.same);
    TEST_ASSERT_EQUAL_INT16(8, owed.told[0]);
    TEST_ASSERT_EQUAL_INT16(7, owed.told[1]);
    owed_tell(&owed, 8);
    owed_tell(&owed, 7);
    TEST_ASSERT_EQUAL_UINT8(0, owed.same);
}

TEST(what_rounding_adds_up_to_is_not_owed_either_way)
{
    owed.counts = 3;
    TEST_ASSERT_EQUAL_INT32(0, owed_counts(&owed));
    owed.counts = -5;
    TEST_ASSERT_EQUAL_INT32(0, owed_counts(&owed));
    owed.counts = 6;
    TEST_ASSERT_EQUAL_INT32(6, owed_counts(&owed));
}
