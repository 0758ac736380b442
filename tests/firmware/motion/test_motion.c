#include "firmware/motion/motion.h"

#include <math.h>

#include "tests/test.h"
#include "motion_rig.h"

enum { FRONT = 4 };

static long way_um(void)
{
    return lround(1000.0 * (body.left_mm + body.right_mm) / 2.0);
}

static struct random dice;

void setUp(void)
{
    config_reset(&config);
    random_seed(&dice, 1);
    stand_at(0.0, 0.0);
}

TEST(positive_turn_is_to_the_right)
{
    begin(10, 0);
    TEST_ASSERT_GREATER_THAN_INT16(0, commanded().left_mm_s);
    TEST_ASSERT_EQUAL_INT16(-commanded().left_mm_s, commanded().right_mm_s);
}

TEST(turn_ends_within_half_a_degree)
{
    for (int turn_deg = -210; turn_deg <= 210; turn_deg++) {
        stand_at(0.0, 0.0);
        if (turn_deg != 0)
            act(turn_deg, 0);
        TEST_ASSERT_INT_WITHIN(HALF, 1000 * turn_deg, heading_mdeg());
    }
}

TEST(random_turns_do_not_accumulate_error)
{
    int sum_deg = 0;

    for (unsigned i = 0; i < 1000; i++) {
        int turn_deg = (random_below(&dice, 2) ? 1 : -1) * (1 + random_below(&dice, 210));

        sum_deg += turn_deg;
        act(turn_deg, 0);
        TEST_ASSERT_INT_WITHIN(HALF, 1000 * sum_deg, heading_mdeg());
    }
}

/* A thousand turns all one way: an error that always has the same sign shows here. */
TEST(equal_turns_do_not_accumulate_error)
{
    for (unsigned i = 1; i <= 1000; i++)
        act(10, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 10000000, heading_mdeg());
}

TEST(steps_between_turns_keep_the_heading)
{
    for (unsigned i = 0; i < 1000; i++) {
        act(7, 0);
        act(0, 12);
    }
    TEST_ASSERT_INT_WITHIN(HALF, 7000000, heading_mdeg());
}

TEST(turn_does_not_move_the_body)
{
    act(210, 0);
    TEST_ASSERT_INT_WITHIN(ROUNDING, 0, way_um());
}

TEST(turn_corrects_the_error_of_the_turn_before)
{
    act(90, 0);
    body.left_mm += 8.0;   /* a knock turns the body by 2.9 degrees, and the wheels feel it */
    act(-90, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 0, heading_mdeg());
}

TEST(step_ends_within_half_a_millimetre)
{
    for (unsigned forward_mm = 1; forward_mm <= 250; forward_mm++) {
        stand_at(0.0, 0.0);
        act(0, forward_mm);
        TEST_ASSERT_INT_WITHIN(HALF, 1000 * (long)forward_mm, way_um());
    }
}

TEST(step_keeps_the_heading)
{
    act(0, STEP_MAX_MM);
    TEST_ASSERT_INT_WITHIN(ROUNDING, 0, heading_mdeg());
}

TEST(step_ends_in_the_tick_that_senses_an_obstacle)
{
    begin(0, STEP_MAX_MM);
    TEST_ASSERT_FALSE(tick());
    body.feel = FRONT;
    TEST_ASSERT_TRUE(tick());
}

TEST(step_continues_with_an_obstacle_at_the_side)
{
    begin(0, STEP_MAX_MM);
    body.feel = 1 | 16;
    TEST_ASSERT_FALSE(tick());
}

TEST(turn_continues_at_an_obstacle)
{
    body.feel = FRONT;
    act(45, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 45000, heading_mdeg());
}

TEST(rest_of_a_stopped_step_is_not_driven_later)
{
    begin(0, STEP_MAX_MM);
    body.feel = FRONT;
    TEST_ASSERT_TRUE(tick());
    body.feel = 0;
    stand_at(0.0, 0.0);
    act(0, 12);
    TEST_ASSERT_INT_WITHIN(HALF, 12000, way_um());
}

TEST(step_is_exact_when_odometers_wrap_forward)
{
    stand_at(409.0, 409.0);   /* 6 counts before the wrap */
    act(0, 12);
    TEST_ASSERT_INT_WITHIN(HALF, 421000, way_um());
}

TEST(turn_is_exact_when_odometers_wrap_backward)
{
    stand_at(0.3, 0.3);
    act(180, 0);
    act(-180, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 0, heading_mdeg());
}

TEST(rest_action_lasts_one_tick)
{
    TEST_ASSERT_EQUAL_UINT(1, act(0, 0));
}

TEST(wheels_rest_between_actions)
{
    act(0, 0);
    TEST_ASSERT_EQUAL_INT16(0, commanded().left_mm_s);
    TEST_ASSERT_EQUAL_INT16(0, commanded().right_mm_s);
}

TEST(motion_has_ended_before_the_first_action)
{
    const struct senses senses = sensed();

    TEST_ASSERT_TRUE(motion_ended(&motion, &config, &senses));
}

TEST(step_commands_the_speed_parameter)
{
    begin(0, STEP_MAX_MM);
    TEST_ASSERT_EQUAL_INT16(200, commanded().left_mm_s);
}

/* 180 degrees/s with 160 mm between the wheels: each makes 80 mm * pi a second. */
TEST(turn_commands_the_turn_speed_parameter)
{
    begin(210, 0);
    TEST_ASSERT_INT16_WITHIN(1, 251, commanded().left_mm_s);
}

TEST(turns_are_exact_at_the_limits_of_parameters)
{
    static const int turns_deg[] = {1, 90, 180, TURN_MAX_DEG};

    for (unsigned corner = 0; corner < 16; corner++)
        for (unsigned i = 0; i < 4; i++) {
            set_corner(corner);
            stand_at(0.0, 0.0);
            act(turns_deg[i], 0);
            TEST_ASSERT_INT_WITHIN(HALF, 1000 * turns_deg[i], heading_mdeg());
        }
}

TEST(steps_are_exact_at_the_limits_of_parameters)
{
    static const unsigned steps_mm[] = {1, 250};

    for (unsigned corner = 0; corner < 16; corner++)
        for (unsigned i = 0; i < 2; i++) {
            set_corner(corner);
            stand_at(0.0, 0.0);
            act(0, steps_mm[i]);
            TEST_ASSERT_INT_WITHIN(HALF, 1000 * (long)steps_mm[i], way_um());
        }
}

static bool tick_seeing_food(bool look)
{
    struct senses senses = sensed();

    senses.look = look;
    motion_track(&motion, &senses);
    return motion_ended(&motion, &config, &senses);
}

TEST(turn_for_food_ends_when_food_is_seen)
{
    const struct action around = {.turn_deg = 360, .until_food = true};

    motion_begin(&motion, &config, &around);
    for (unsigned i = 0; i < 10; i++)
        TEST_ASSERT_FALSE(tick());
    TEST_ASSERT_FALSE(tick_seeing_food(false));
    TEST_ASSERT_TRUE(tick_seeing_food(true));
}

TEST(other_turn_continues_when_food_is_seen)
{
    begin(180, 0);
    tick();
    TEST_ASSERT_FALSE(tick_seeing_food(true));
}

TEST(rest_of_a_turn_for_food_is_dropped)
{
    const struct action around = {.turn_deg = 360, .until_food = true};
    long before;

    motion_begin(&motion, &config, &around);
    for (unsigned i = 0; i < 10; i++)
        tick();
    TEST_ASSERT_TRUE(tick_seeing_food(true));
    before = heading_mdeg();
    act(-90, 0);
    TEST_ASSERT_INT_WITHIN(HALF, before - 90000, heading_mdeg());
}

TEST(action_includes_its_rest_ticks)
{
    const struct action trial = {.turn_deg = 45, .rest_ticks = 2};

    motion_begin(&motion, &config, &trial);
    while (!tick())
        ;
    TEST_ASSERT_TRUE(motion_rest(&motion, &config));
    TEST_ASSERT_EQUAL(0, commanded().left_mm_s);
    TEST_ASSERT_FALSE(tick());
    TEST_ASSERT_EQUAL(0, commanded().left_mm_s);
    TEST_ASSERT_TRUE(tick());
    TEST_ASSERT_FALSE(motion_rest(&motion, &config));
}
