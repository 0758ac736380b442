/* Wheels that roll apart in a step, or together in a turn: one of them does not obey. */
#include "firmware/motion/motion.h"
#include "tests/test.h"
#include "motion_rig.h"

void setUp(void)
{
    config_reset(&config);
    random_seed(&dice, 1);
    stand_at(0.0, 0.0);
}

/* Steps until the wheels are denied; none if they never are. */
static unsigned steps_until_denied(double lame)
{
    body.lame = lame;
    for (unsigned steps = 1; steps <= 100; steps++) {
        act(0, 12);
        if (motion_is_denied(&motion, &config))
            return steps;
    }
    return 0;
}

/* A step of 12 mm on one wheel takes 8 ticks: a wheel that stands still for 100 is dead. */
TEST(one_dead_wheel_is_denied_after_some_steps)
{
    TEST_ASSERT_EQUAL_UINT(13, steps_until_denied(0.0));
}

/* Such a step goes astray by some 16 of 240 counts; 1004 are too much. */
TEST(one_wheel_that_hardly_rolls_is_denied_in_the_end)
{
    TEST_ASSERT_EQUAL_UINT(61, steps_until_denied(0.1));
}

TEST(one_wheel_that_rolls_backward_is_denied_sooner)
{
    TEST_ASSERT_EQUAL_UINT(3, steps_until_denied(-0.5));
}

TEST(one_weak_wheel_is_not_denied_however_many_steps_it_takes)
{
    for (unsigned percent = 20; percent <= 100; percent += 10)
        TEST_ASSERT_EQUAL_UINT(0, steps_until_denied(percent / 100.0));
}

TEST(one_dead_wheel_is_denied_in_short_turns_either_way)
{
    unsigned turns = 0;

    for (body.lame = 0.0; !motion_is_denied(&motion, &config); turns++) {
        TEST_ASSERT_LESS_THAN_UINT(30, turns);
        act(turns % 2 ? 10 : -10, 0);
    }
    TEST_ASSERT_GREATER_THAN_UINT(3, turns);
}

TEST(a_wheel_that_is_mended_is_believed_after_one_step)
{
    TEST_ASSERT_NOT_EQUAL_UINT(0, steps_until_denied(0.1));
    act(0, 12);
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
    body.lame = 1.0;
    act(0, 12);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
}

/* Where drives are lost, a body goes on turning for 5 ticks while the robot takes steps. */
TEST(wheels_that_go_on_turning_for_some_ticks_are_not_denied)
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

TEST(wheels_that_go_ever_farther_astray_stay_denied)
{
    begin(0, 250);
    for (unsigned ticks = 0; ticks < 100; ticks++) {
        tear_apart();
        TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
    }
}

/* However far they had gone: what is held against them is no more than what denies one action. */
TEST(wheels_that_were_far_astray_are_believed_after_one_step_too)
{
    begin(0, 250);
    for (unsigned ticks = 0; ticks < 100; ticks++)
        tear_apart();
    act(0, 12);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
}
