/* Straying: wheels that roll apart in a step, or together in a turn, because one of them does not obey. */
#include "firmware/motion/motion.h"
#include "tests/test.h"
#include "motion_rig.h"

static struct random dice;

void setUp(void)
{
    config_reset(&config);
    random_seed(&dice, 1);
    stand_at(0.0, 0.0);
}

/* Steps until the wheels are denied; none if they never are. */
static unsigned steps_until_denied(double left_share)
{
    body.left_share = left_share;
    for (unsigned steps = 1; steps <= 100; steps++) {
        act(0, 12);
        if (motion_is_denied(&motion, &config))
            return steps;
    }
    return 0;
}

/* A step of 12 mm on one wheel takes 8 ticks: a wheel that stands still for 100 is dead. */
TEST(dead_wheel_is_denied_after_13_steps)
{
    TEST_ASSERT_EQUAL_UINT(13, steps_until_denied(0.0));
}

/* Such a step goes astray by some 16 of 240 counts; 1004 are too much. */
TEST(wheel_at_a_tenth_of_its_speed_is_denied_after_61_steps)
{
    TEST_ASSERT_EQUAL_UINT(61, steps_until_denied(0.1));
}

TEST(wheel_that_rolls_backward_is_denied_after_3_steps)
{
    TEST_ASSERT_EQUAL_UINT(3, steps_until_denied(-0.5));
}

TEST(wheel_at_a_fifth_of_its_speed_is_not_denied_in_steps)
{
    for (unsigned percent = 20; percent <= 100; percent += 10)
        TEST_ASSERT_EQUAL_UINT(0, steps_until_denied(percent / 100.0));
}

TEST(dead_wheel_is_denied_in_short_turns)
{
    unsigned turns = 0;

    for (body.left_share = 0.0; !motion_is_denied(&motion, &config); turns++) {
        TEST_ASSERT_LESS_THAN_UINT(30, turns);
        act(turns % 2 ? 10 : -10, 0);
    }
    TEST_ASSERT_GREATER_THAN_UINT(3, turns);
}

TEST(repaired_wheel_is_credible_after_one_step)
{
    TEST_ASSERT_NOT_EQUAL_UINT(0, steps_until_denied(0.1));
    act(0, 12);
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
    body.left_share = 1.0;
    act(0, 12);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
}

/* Where drives are lost, a body goes on turning for 5 ticks while the robot takes steps. */
TEST(wheels_finishing_a_turn_in_a_step_are_not_denied)
{
    struct senses senses;

    begin(0, 12);
    body.left_mm += 25.0;
    body.right_mm -= 25.0;
    senses = sensed();
    motion_track(&motion, &senses);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
}

/* A tick in which something tears the wheels apart. */
static void tear_apart(void)
{
    struct senses senses;

    body.left_mm += 150.0;
    body.right_mm -= 150.0;
    senses = sensed();
    motion_track(&motion, &senses);
}

TEST(wheels_that_keep_straying_stay_denied)
{
    begin(0, 250);
    for (unsigned ticks = 0; ticks < 100; ticks++) {
        tear_apart();
        TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
    }
}

/* However far they went: the straying kept for the next action is just enough to deny one. */
TEST(wheels_far_astray_are_credible_after_one_step)
{
    begin(0, 250);
    for (unsigned ticks = 0; ticks < 100; ticks++)
        tear_apart();
    act(0, 12);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
}
