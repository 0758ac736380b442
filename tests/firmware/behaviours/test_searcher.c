#include "brain_rig.h"

#include "firmware/memory_kind.h"

void setUp(void)
{
    begin(PROFILE_SEARCHER);
}

void tearDown(void) {}

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

static void test_it_begins_by_turning_once_around(void)
{
    assert_turns_once_around();
}

static void test_it_drives_a_metre_straight_on_between_two_turns(void)
{
    assert_turns_once_around();
    steps(84);   /* of 12 mm */
    assert_turns_once_around();
}

static void test_it_goes_to_what_it_sees(void)
{
    TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_seeing_food(CLEAR, 900).reason);
    TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_seeing_food(CLEAR, 150).reason);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(CLEAR, 149).reason);
}

static void test_after_a_meal_it_looks_for_the_next(void)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_turns_once_around();
}

static void test_when_it_has_lost_the_food_it_drives_on_a_little(void)
{
    next_seeing_food(CLEAR, 900);
    steps(17);
    assert_turns_once_around();
}

/* Lost again and again, the food is in a place that it cannot be reached from. */
static void test_each_time_that_it_has_lost_food_it_drives_on_twice_as_far(void)
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

static void test_it_goes_on_in_any_direction(void)
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

static void test_it_learns_as_adaptive_does(void)
{
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_EQUAL(2, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
}

static void test_a_turn_around_ends_the_count(void)
{
    brain.repeat_count = 7;
    assert_turns_once_around();
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}

static void test_it_turns_around_either_way(void)
{
    unsigned to_the_right = 0;
    unsigned turns = 100;

    for (uint32_t seed = 0; seed < turns; seed++) {
        TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, seed));
        to_the_right += next(CLEAR).turn_deg > 0;
    }
    TEST_ASSERT_UINT_WITHIN(20, turns / 2, to_the_right);
}

static void test_boredom_turns_it_about_though_the_way_is_clear(void)
{
    memory_put(&brain.memory, MEMORY_KIND_CONFIDENCE, PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(config.value[BOREDOM_LIMIT]);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(CLEAR).reason);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
}

static void test_it_learns_and_stores_it(void)
{
    TEST_ASSERT_TRUE(brain.learns);
}

static void test_it_turns_to_the_right_where_the_draw_is_1(void)
{
    for (uint32_t seed = 0; seed < 100; seed++) {
        struct random dice;

        TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, seed));
        dice = brain.random;
        TEST_ASSERT_EQUAL(random_below(&dice, 2) == 1, next(CLEAR).turn_deg > 0);
    }
}

/* Nine steps of 111 mm are 999 mm. */
static void test_it_looks_around_after_a_metre_and_not_before(void)
{
    config.value[STEP_MM] = 111;
    assert_turns_once_around();
    steps(10);
    assert_turns_once_around();
}

static void test_after_losing_food_it_looks_around_after_two_hundred_millimetres_and_not_before(void)
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

static void test_food_that_is_out_of_reach_is_driven_to_step_by_step(void)
{
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_seeing_food(CLEAR, 900).reason);
}

static void test_a_meal_is_over_after_one_look_around(void)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_turns_once_around();
    steps(84);
}

static void test_where_a_step_ends_at_an_obstacle_it_tries_a_turn(void)
{
    assert_turns_once_around();
    steps(1);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
}

static void test_food_seen_where_a_step_ends_at_an_obstacle_counts_as_a_look(void)
{
    const struct senses blocked = {.feel = FRONT, .look = true, .beacon_mm = 900};

    config.value[STEP_MM] = 111;
    assert_turns_once_around();
    steps(1);
    TEST_ASSERT_EQUAL(REASON_TRIAL, brain_next(&brain, &config, &blocked).reason);
    steps(10);
    assert_turns_once_around();
}

static void test_a_start_forgets_the_food_that_it_was_going_to(void)
{
    next_seeing_food(CLEAR, 900);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, 1));
    assert_turns_once_around();
}

static void test_a_start_forgets_the_food_that_it_has_lost(void)
{
    next_seeing_food(CLEAR, 900);
    steps(17);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, 1));
    next_seeing_food(CLEAR, 900);
    steps(17);
    assert_turns_once_around();
}

static void test_a_trial_is_not_judged_again_after_the_look_around_that_follows_it(void)
{
    next(ALL_THREE);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
    next(FRONT);
    TEST_ASSERT_EQUAL(2, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_begins_by_turning_once_around);
    RUN_TEST(test_it_drives_a_metre_straight_on_between_two_turns);
    RUN_TEST(test_it_goes_to_what_it_sees);
    RUN_TEST(test_after_a_meal_it_looks_for_the_next);
    RUN_TEST(test_when_it_has_lost_the_food_it_drives_on_a_little);
    RUN_TEST(test_each_time_that_it_has_lost_food_it_drives_on_twice_as_far);
    RUN_TEST(test_it_goes_on_in_any_direction);
    RUN_TEST(test_it_learns_as_adaptive_does);
    RUN_TEST(test_a_turn_around_ends_the_count);
    RUN_TEST(test_it_turns_around_either_way);
    RUN_TEST(test_boredom_turns_it_about_though_the_way_is_clear);
    RUN_TEST(test_it_learns_and_stores_it);
    RUN_TEST(test_it_turns_to_the_right_where_the_draw_is_1);
    RUN_TEST(test_it_looks_around_after_a_metre_and_not_before);
    RUN_TEST(test_after_losing_food_it_looks_around_after_two_hundred_millimetres_and_not_before);
    RUN_TEST(test_food_that_is_out_of_reach_is_driven_to_step_by_step);
    RUN_TEST(test_a_meal_is_over_after_one_look_around);
    RUN_TEST(test_where_a_step_ends_at_an_obstacle_it_tries_a_turn);
    RUN_TEST(test_food_seen_where_a_step_ends_at_an_obstacle_counts_as_a_look);
    RUN_TEST(test_a_start_forgets_the_food_that_it_was_going_to);
    RUN_TEST(test_a_start_forgets_the_food_that_it_has_lost);
    RUN_TEST(test_a_trial_is_not_judged_again_after_the_look_around_that_follows_it);
    return UNITY_END();
}
