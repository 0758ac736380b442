/* The backlog: what wheels have still to roll, whatever their lag, delay and gain. */
#include "tests/test.h"
#include "firmware/motion/odometry_backlog.h"
#include "firmware/motion/wheels.h"

#include <math.h>

enum { FULL = 100, HALF_A_DEGREE = 14 };   /* of both wheels in a tick, turning */

static struct backlog backlog;

BEFORE_EACH(odometry_backlog)
{
    backlog = (struct backlog){.counts = 0};
}

/* Commands FULL in each tick to such wheels. Returns the counts that they have rolled. */
static double follow(double lag_ticks, unsigned delay, double gain, unsigned ticks)
{
    double speed = 0.0, way = 0.0, seen = 0.0;

    for (unsigned i = 0; i < ticks; i++) {
        double aim = i >= delay ? gain * FULL : 0.0;
        double part = lag_ticks > 0.0 ? lag_ticks * (1.0 - exp(-1.0 / lag_ticks)) : 0.0;
        double rolled = aim + (speed - aim) * part;

        backlog_command(&backlog, FULL);
        speed = lag_ticks > 0.0 ? aim + (speed - aim) * exp(-1.0 / lag_ticks) : aim;
        way += rolled;
        backlog_roll(&backlog, (int32_t)(floor(way) - floor(seen)), 1);
        seen = way;
    }
    return way;
}

TEST(backlog_is_commanded_minus_rolled_distance)
{
    for (unsigned lag = 0; lag <= 5; lag++)
        for (unsigned delay = 0; delay <= 2; delay++)
            for (unsigned ticks = 1; ticks <= 40; ticks++) {
                double way;

                prepare_odometry_backlog();
                way = follow(lag, delay, 1.0, ticks);
                TEST_ASSERT_INT_WITHIN(2 * HALF_A_DEGREE, (int)(FULL * ticks - way), backlog.counts);
            }
}

/* Distance missing at a steady speed will never be rolled. */
TEST(backlog_of_slow_wheels_stops_growing)
{
    (void)follow(0.0, 0, 0.8, 60);
    TEST_ASSERT_INT_WITHIN(FULL / 2, 0, backlog.counts);
}

TEST(fast_wheels_have_no_backlog)
{
    (void)follow(0.0, 0, 1.2, 60);
    TEST_ASSERT_EQUAL_INT32(0, backlog_counts(&backlog));
}

TEST(backlog_of_stopped_wheels_is_at_most_two_commands)
{
    for (unsigned i = 0; i < 10; i++) {
        backlog_command(&backlog, FULL);
        backlog_roll(&backlog, 0, 1);
    }
    TEST_ASSERT_EQUAL_INT32(2 * FULL, backlog_counts(&backlog));
    for (unsigned i = 0; i < 2; i++) {
        backlog_command(&backlog, 0);
        backlog_roll(&backlog, 0, 1);
    }
    TEST_ASSERT_EQUAL_INT32(0, backlog_counts(&backlog));
}

TEST(backlog_up_to_5_counts_is_read_as_0)
{
    backlog.counts = 5;
    TEST_ASSERT_EQUAL_INT32(0, backlog_counts(&backlog));
    backlog.counts = -6;
    TEST_ASSERT_EQUAL_INT32(-6, backlog_counts(&backlog));
}

TEST(extreme_commands_and_odometers_do_not_overflow)
{
    for (int i = 0; i < 100; i++) {
        backlog_command(&backlog, i % 3 ? 6400 : -6400);
        backlog_roll(&backlog, i % 2 ? 4095 : -4096, 5);
        TEST_ASSERT_INT_WITHIN(16000, 0, backlog.counts);
    }
}

/* The backlog after some ticks in which wheels rolled so many counts. */
static int after(struct backlog before, int rolled, unsigned ticks)
{
    backlog_roll(&before, rolled, ticks);
    TEST_ASSERT_EQUAL_INT16(rolled, before.rolled);
    return before.counts;
}

static void assert_either_way(int expected, struct backlog before, int rolled)
{
    struct backlog back = {.counts = (int16_t)-before.counts, .rolled = (int16_t)-before.rolled, .same = before.same};

    back.commanded[0] = (int16_t)-before.commanded[0];
    back.commanded[1] = (int16_t)-before.commanded[1];
    TEST_ASSERT_EQUAL_INT(expected, after(before, rolled, 1));
    TEST_ASSERT_EQUAL_INT(-expected, after(back, -rolled, 1));
}

TEST(command_adds_to_the_backlog_until_it_takes_effect)
{
    assert_either_way(40 + 40, (struct backlog){.counts = 40, .rolled = 58, .commanded = {100, 100}, .same = 1}, 60);
    assert_either_way(40 + 12, (struct backlog){.counts = 40, .rolled = 58, .commanded = {100, 100}, .same = 2}, 60);
    assert_either_way(40 - 60, (struct backlog){.counts = 40, .rolled = 60, .commanded = {0, -100}, .same = 9}, 60);
}

TEST(wheels_below_4_counts_are_treated_as_starting)
{
    assert_either_way(95, (struct backlog){.rolled = 3, .commanded = {100, 100}, .same = 9}, 5);
    assert_either_way(6, (struct backlog){.rolled = 4, .commanded = {100, 100}, .same = 9}, 5);
}

TEST(acceleration_adds_at_most_the_missing_speed)
{
    assert_either_way(10, (struct backlog){.rolled = 60, .commanded = {100, 100}, .same = 9}, 90);
    assert_either_way(60 - 50, (struct backlog){.counts = 60, .rolled = 60, .commanded = {100, 100}, .same = 9}, 50);
}

TEST(acceleration_within_rounding_adds_no_backlog)
{
    assert_either_way(60, (struct backlog){.counts = 60, .rolled = 98, .commanded = {100, 100}, .same = 9}, 97);
    assert_either_way(60 - 4, (struct backlog){.counts = 60, .rolled = 97, .commanded = {100, 100}, .same = 9}, 96);
    assert_either_way(60, (struct backlog){.counts = 60, .rolled = 101, .commanded = {100, 100}, .same = 9}, 102);
    assert_either_way(60 + 1, (struct backlog){.counts = 60, .rolled = 98, .commanded = {100, 100}, .same = 9}, 99);
    assert_either_way(60, (struct backlog){.counts = 60, .rolled = 102, .commanded = {100, 100}, .same = 9}, 102);
}

TEST(backlog_is_limited_by_the_coasting_distance)
{
    assert_either_way(60, (struct backlog){.counts = 100, .rolled = 10}, 10);
    assert_either_way(72, (struct backlog){.counts = 100, .rolled = 6}, 10);
    assert_either_way(48, (struct backlog){.counts = 100, .rolled = 14}, 10);
    assert_either_way(0, (struct backlog){.counts = 100, .rolled = 14}, 2);
    assert_either_way(0, (struct backlog){.counts = 100, .rolled = 20}, 0);
    assert_either_way(0, (struct backlog){.counts = 100}, 0);
    assert_either_way(0, (struct backlog){.counts = -100, .rolled = 10}, 10);
    assert_either_way(7 - 1, (struct backlog){.counts = 7, .rolled = 1}, 1);
    assert_either_way(0, (struct backlog){.counts = 100, .rolled = 100}, -1);
    assert_either_way(0, (struct backlog){.counts = 100, .rolled = -100}, -1);
    assert_either_way(0, (struct backlog){.counts = 100, .rolled = -10}, 0);
}

TEST(backlog_is_limited_by_two_commands_plus_coasting)
{
    assert_either_way(30, (struct backlog){.counts = 100, .commanded = {30, 0}}, 0);
    assert_either_way(30, (struct backlog){.counts = 100, .commanded = {0, 30}}, 0);
    assert_either_way(60, (struct backlog){.counts = 100, .commanded = {30, 30}}, 0);
    assert_either_way(30, (struct backlog){.counts = 100, .commanded = {30, -20}}, 0);
    assert_either_way(-20, (struct backlog){.counts = -100, .commanded = {30, -20}}, 0);
    assert_either_way(30 + 20 + 60, (struct backlog){.counts = 200, .rolled = 10, .commanded = {30, 20}}, 10);
    assert_either_way(30, (struct backlog){.commanded = {30, 20}}, 0);
    assert_either_way(1, (struct backlog){.counts = 9, .commanded = {0, 1}}, 0);
    assert_either_way(1, (struct backlog){.counts = 9, .commanded = {1, 0}}, 0);
}

TEST(command_counts_for_every_tick_of_a_gap)
{
    TEST_ASSERT_EQUAL_INT(60 - 10, after((struct backlog){.commanded = {30, 30}}, 10, 2));
    TEST_ASSERT_EQUAL_INT(-60 + 10, after((struct backlog){.commanded = {-30, -30}}, -10, 2));
}

TEST(backlog_saturates_at_16000)
{
    assert_either_way(16000, (struct backlog){.counts = 15990, .commanded = {9000, 9000}}, 0);
}

TEST(count_of_equal_commands_saturates_at_255)
{
    backlog_command(&backlog, 7);
    TEST_ASSERT_EQUAL_UINT8(0, backlog.same);
    for (unsigned i = 1; i <= 300; i++) {
        backlog_command(&backlog, 7);
        TEST_ASSERT_EQUAL_UINT8(i < 255 ? i : 255, backlog.same);
    }
    backlog_command(&backlog, 8);
    TEST_ASSERT_EQUAL_UINT8(0, backlog.same);
    TEST_ASSERT_EQUAL_INT16(8, backlog.commanded[0]);
    TEST_ASSERT_EQUAL_INT16(7, backlog.commanded[1]);
    backlog_command(&backlog, 8);
    backlog_command(&backlog, 7);
    TEST_ASSERT_EQUAL_UINT8(0, backlog.same);
}

TEST(backlog_of_rounding_errors_is_read_as_0_in_both_directions)
{
    backlog.counts = 3;
    TEST_ASSERT_EQUAL_INT32(0, backlog_counts(&backlog));
    backlog.counts = -5;
    TEST_ASSERT_EQUAL_INT32(0, backlog_counts(&backlog));
    backlog.counts = 6;
    TEST_ASSERT_EQUAL_INT32(6, backlog_counts(&backlog));
}

static struct config config;

BEFORE_EACH(wheels)
{
    config_reset(&config);
}

TEST(turn_per_degree_follows_the_wheel_track)
{
    TEST_ASSERT_EQUAL_UINT32(457528, wheels_turn_per_degree(&config));   /* 160 mm * pi / 180 */
}

TEST(fastest_speed_is_the_greater_of_both_parameters)
{
    TEST_ASSERT_EQUAL_UINT32(251, wheels_turning_mm_s(&config));
    TEST_ASSERT_EQUAL_UINT32(251, wheels_fastest_mm_s(&config));
    config.value[TURN_SPEED_DEG_S] = 30;
    TEST_ASSERT_EQUAL_UINT32(200, wheels_fastest_mm_s(&config));
}

TEST(counts_per_tick_are_rounded)
{
    TEST_ASSERT_EQUAL_UINT32(80, wheels_counts_at(200, &config));
    TEST_ASSERT_EQUAL_UINT32(100, wheels_counts_at(251, &config));
    TEST_ASSERT_EQUAL_UINT32(101, wheels_counts_at(252, &config));
}

TEST(counts_between_odometers_wrap)
{
    TEST_ASSERT_EQUAL_INT32(2, wheels_counts_between(4095, 1));
    TEST_ASSERT_EQUAL_INT32(-2, wheels_counts_between(1, 4095));
    TEST_ASSERT_EQUAL_INT32(2047, wheels_counts_between(0, 2047));
    TEST_ASSERT_EQUAL_INT32(-2048, wheels_counts_between(0, 2048));
}

TEST(wheels_limited_limits_both_signs)
{
    TEST_ASSERT_EQUAL_INT32(5, wheels_limited(6, 5));
    TEST_ASSERT_EQUAL_INT32(-5, wheels_limited(-6, 5));
    TEST_ASSERT_EQUAL_INT32(-4, wheels_limited(-4, 5));
    TEST_ASSERT_EQUAL_UINT32(7, wheels_magnitude(-7));
}
