/* The whole robot on wheels that follow as motors do. wheel_sweep.py does the same with many more. */
#include "firmware/robot.h"

#include "tests/test.h"
#include "wheel_run.h"

enum { MINUTE_TICKS = 3000 };

static struct wheel_figures run_at(double lag_ms, int delay_ticks, uint32_t seed)
{
    const struct wheel_traits traits = {.lag_ms = lag_ms, .gain = 1.0, .slack_mm = 1.1, .delay_ticks = delay_ticks};

    return wheel_run(PROFILE_ADAPTIVE, seed, MINUTE_TICKS, &traits);
}

TEST(lagging_wheels_complete_every_action)
{
    for (int lag_ms = 0; lag_ms <= 100; lag_ms += 10)
        for (int delay_ticks = 0; delay_ticks <= 2; delay_ticks++) {
            const struct wheel_figures figures = run_at(lag_ms, delay_ticks, 1);

            TEST_ASSERT_EQUAL_INT(0, figures.denied);
            TEST_ASSERT_EQUAL_INT(-1, figures.stopped_tick);
            TEST_ASSERT_GREATER_THAN_INT(700, figures.actions);
        }
}

TEST(turn_on_lagging_wheels_errs_by_at_most_2_degrees)
{
    for (int lag_ms = 0; lag_ms <= 60; lag_ms += 5) {
        const struct wheel_figures figures = run_at(lag_ms, 0, 1);

        TEST_ASSERT_TRUE(figures.slack_deg <= 1.0);
        TEST_ASSERT_TRUE(figures.over_deg <= 2.0);
    }
}

/* A turn may end right even so, if the wheels still rolled that way when it began. */
TEST(wheels_with_300_ms_lag_stop_the_robot_before_it_learns)
{
    int lessons = 0;

    for (uint32_t seed = 1; seed <= 10; seed++)
        for (int delay_ticks = 0; delay_ticks <= 2; delay_ticks++) {
            const struct wheel_figures figures = run_at(300.0, delay_ticks, seed);

            TEST_ASSERT_NOT_EQUAL_INT(-1, figures.stopped_tick);
            lessons += figures.lessons;
        }
    TEST_ASSERT_LESS_OR_EQUAL_INT(1, lessons);
}
