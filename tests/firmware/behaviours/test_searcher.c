#include "brain_rig.h"

#include "firmware/memory/memory_kind.h"

void setUp(void)
{
    begin(PROFILE_SEARCHER);
}

static void steps(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(REASON_WANDER, next(CLEAR).reason);
}

static void assert_turns_once_around(void)
{
    struct action action = next(CLEAR);

    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, action.reason);
    TEST_ASSERT_INT_WITHIN(90, 449, action.turn_deg < 0 ? -action.turn_deg : action.turn_deg);
    TEST_ASSERT_TRUE(action.until_food);
}

TEST(it_begins_by_turning_once_around)
{
    assert_turns_once_around();
}

TEST(it_drives_a_metre_straight_on_between_two_turns)
{
    assert_turns_once_around();
    steps(84);   /* of 12 mm */
    assert_turns_once_around();
}

TEST(it_goes_to_what_it_sees)
{
    TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_seeing_food(CLEAR, 900).reason);
    TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_seeing_food(CLEAR, 150).reason);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(CLEAR, 149).reason);
}

TEST(after_a_meal_it_looks_for_the_next)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_turns_once_around();
}

TEST(when_it_has_lost_the_food_it_drives_on_a_little)
{
    next_seeing_food(CLEAR, 900);
    steps(17);
    assert_turns_once_around();
}

/* Lost again and again, the food is in a place that it cannot be reached from. */
TEST(each_time_that_it_has_lost_food_it_drives_on_twice_as_far)
{
    static const unsigned ways[] = {17, 34, 67, 67};   /* in steps of 12 mm: 200 mm and on */

    for (unsigned i = 0; i < sizeof ways / sizeof ways[0]; i++) {
        next_seeing_food(CLEAR, 900);
        steps(ways[i]);
        assert_turns_once_around();
    }
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);   /* a meal */
    assert_turns_once_around();
    next_seeing_food(CLEAR, 900);
    steps(ways[0]);
    assert_turns_once_around();
}

TEST(it_goes_on_in_any_direction)
{
    bool seen[180] = {false};
    unsigned directions = 0;

    for (uint32_t seed = 0; seed < 4000; seed++) {
        int turn_deg;

        TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, seed));
        turn_deg = next(CLEAR).turn_deg;
        seen[(turn_deg < 0 ? -turn_deg : turn_deg) - 360] = true;
    }
    for (unsigned i = 0; i < 180; i++)
        directions += seen[i];
    TEST_ASSERT_EQUAL_UINT(180, directions);
}

TEST(it_learns_as_adaptive_does)
{
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_EQUAL(2, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
}

TEST(a_turn_around_ends_the_count)
{
    brain.repeat_count = 7;
    assert_turns_once_around();
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}

TEST(it_turns_around_either_way)
{
    unsigned to_the_right = 0;
    unsigned turns = 100;

    for (uint32_t seed = 0; seed < turns; seed++) {
        TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, seed));
        to_the_right += next(CLEAR).turn_deg > 0;
    }
    TEST_ASSERT_UINT_WITHIN(20, turns / 2, to_the_right);
}

TEST(boredom_turns_it_about_though_the_way_is_clear)
{
    memory_put(&brain.memory, MEMORY_KIND_CONFIDENCE, PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(config.value[BOREDOM_LIMIT]);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(CLEAR).reason);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
}

TEST(it_learns_and_stores_it)
{
    TEST_ASSERT_TRUE(brain.learns);
}

TEST(it_turns_to_the_right_where_the_draw_is_1)
{
    for (uint32_t seed = 0; seed < 100; seed++) {
        struct random dice;

        TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, seed));
        dice = brain.random;
        TEST_ASSERT_EQUAL(random_below(&dice, 2) == 1, next(CLEAR).turn_deg > 0);
    }
}

/* Nine steps of 111 mm are 999 mm. */
TEST(it_looks_around_after_a_metre_and_not_before)
{
    config.value[STEP_MM] = 111;
    assert_turns_once_around();
    steps(10);
    assert_turns_once_around();
}

TEST(after_losing_food_it_looks_around_after_two_hundred_millimetres_and_not_before)
{
    static const unsigned steps_of[][2] = {{200, 1}, {199, 2}};

    for (unsigned i = 0; i < 2; i++) {
        begin(PROFILE_SEARCHER);
        config.value[STEP_MM] = (uint8_t)steps_of[i][0];
        next_seeing_food(CLEAR, 900);
        steps(steps_of[i][1]);
        assert_turns_once_around();
    }
}

TEST(food_that_is_out_of_reach_is_driven_to_step_by_step)
{
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_seeing_food(CLEAR, 900).reason);
}

TEST(a_meal_is_over_after_one_look_around)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_turns_once_around();
    steps(84);
}

TEST(where_a_step_ends_at_an_obstacle_it_tries_a_turn)
{
    assert_turns_once_around();
    steps(1);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
}

TEST(food_seen_where_a_step_ends_at_an_obstacle_counts_as_a_look)
{
    const struct senses blocked = {.feel = FRONT, .look = true, .beacon_mm = 900};

    config.value[STEP_MM] = 111;
    assert_turns_once_around();
    steps(1);
    TEST_ASSERT_EQUAL(REASON_TRIAL, brain_next(&brain, &config, &blocked).reason);
    steps(10);
    assert_turns_once_around();
}

TEST(a_start_forgets_the_food_that_it_was_going_to)
{
    next_seeing_food(CLEAR, 900);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, 1));
    assert_turns_once_around();
}

TEST(a_start_forgets_the_food_that_it_has_lost)
{
    next_seeing_food(CLEAR, 900);
    steps(17);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, 1));
    next_seeing_food(CLEAR, 900);
    steps(17);
    assert_turns_once_around();
}

TEST(a_trial_is_not_judged_again_after_the_look_around_that_follows_it)
{
    next(ALL_THREE);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
    next(FRONT);
    TEST_ASSERT_EQUAL(2, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
}
