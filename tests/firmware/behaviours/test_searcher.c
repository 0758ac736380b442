#include "brain_rig.h"

#include <stdlib.h>

#include "firmware/memory/memory.h"

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
    TEST_ASSERT_INT_WITHIN(30, 389, action.turn_deg < 0 ? -action.turn_deg : action.turn_deg);
    TEST_ASSERT_TRUE(action.until_food);
}

TEST(it_begins_by_turning_once_around)
{
    assert_turns_once_around();
}

/* How far it drives on then: 1000 mm, less 8 for each degree beyond the whole turn. */
static unsigned way_mm(void)
{
    return 1000 - 8 * ((unsigned)abs(next(CLEAR).turn_deg) - 360);
}

TEST(it_drives_on_for_a_metre_less_what_it_has_turned_aside)
{
    for (unsigned i = 0; i < 10; i++)
        steps((way_mm() + 11) / 12);
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
TEST(when_it_has_lost_food_again_it_drives_on_twice_as_far)
{
    static const unsigned ways[] = {17, 34, 34};   /* in steps of 12 mm: 200 mm and on */

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

TEST(it_goes_on_up_to_59_degrees_aside)
{
    bool seen[60] = {false};
    unsigned directions = 0;

    for (uint32_t seed = 0; seed < 4000; seed++) {
        TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, seed));
        seen[next(CLEAR).turn_deg - 360] = true;
    }
    for (unsigned i = 0; i < 60; i++)
        directions += seen[i];
    TEST_ASSERT_EQUAL_UINT(60, directions);
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

static void turn_aside_and_lose_food(enum side side)
{
    memory_put(&brain.memory, MEMORY_KIND_CONFIDENCE, PATTERN_FRONT, side);
    next_seeing_food(CLEAR, 900);
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
    steps(17);
}

TEST(lost_food_is_looked_for_on_the_side_of_what_it_has_turned_away_from)
{
    turn_aside_and_lose_food(SIDE_RIGHT);
    TEST_ASSERT_LESS_OR_EQUAL(-360, next(CLEAR).turn_deg);
    begin(PROFILE_SEARCHER);
    turn_aside_and_lose_food(SIDE_LEFT);
    TEST_ASSERT_GREATER_OR_EQUAL(360, next(CLEAR).turn_deg);
}

TEST(a_start_forgets_to_which_side_it_turned)
{
    turn_aside_and_lose_food(SIDE_RIGHT);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, 1));
    next_seeing_food(CLEAR, 900);
    steps(17);
    TEST_ASSERT_GREATER_OR_EQUAL(360, next(CLEAR).turn_deg);
}

TEST(without_food_lost_it_looks_to_the_right)
{
    memory_put(&brain.memory, MEMORY_KIND_CONFIDENCE, PATTERN_FRONT, SIDE_RIGHT);
    next(FRONT);
    TEST_ASSERT_GREATER_OR_EQUAL(360, next(CLEAR).turn_deg);
}

/* Draws until a trial is to that side; it then helps. */
static void learn(uint8_t feel, enum side side)
{
    uint32_t seed = 0;

    do {
        memory_erase(&brain.memory);
        TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, seed++));
    } while ((next(feel).turn_deg > 0) != (side == SIDE_RIGHT));
    next(CLEAR);
}

static void assert_turns_from_the_right(enum side side)
{
    static const uint8_t on_the_right[] = {1, 3}, on_the_left[] = {4, 6};

    for (unsigned i = 0; i < 2; i++) {
        TEST_ASSERT_EQUAL(side, memory_recall(&brain.memory, on_the_right[i]));
        TEST_ASSERT_EQUAL(SIDE_LEFT + SIDE_RIGHT - side, memory_recall(&brain.memory, on_the_left[i]));
        TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
    }
}

TEST(a_lesson_of_one_side_is_one_of_the_other_too)
{
    static const uint8_t on_the_right[] = {FRONT_RIGHT, FRONT_RIGHT | FRONT}, on_the_left[] = {FRONT_LEFT, FRONT_LEFT | FRONT};

    for (unsigned i = 0; i < 2; i++)
        for (enum side side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
            learn(on_the_right[i], side);
            assert_turns_from_the_right(side);
            learn(on_the_left[i], (enum side)(SIDE_LEFT + SIDE_RIGHT - side));
            assert_turns_from_the_right(side);
        }
}

TEST(a_lesson_of_what_is_ahead_says_nothing_of_the_sides)
{
    static const uint8_t alike[] = {FRONT, FRONT_RIGHT | FRONT_LEFT, ALL_THREE};

    for (unsigned i = 0; i < sizeof alike; i++) {
        learn(alike[i], SIDE_LEFT);
        TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_FRONT_RIGHT]);
        TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_FRONT_LEFT]);
    }
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
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
    TEST_ASSERT_EQUAL(REASON_WANDER, next(CLEAR).reason);
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

    config.value[STEP_MM] = 111;   /* nine steps are 999 mm */
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

/* As where another robot's vote filled the cell while it turned. */
TEST(a_lesson_that_its_own_cell_holds_already_is_news_for_the_other_side)
{
    const uint8_t known = (uint8_t)(1u << 2 | (next(FRONT_RIGHT | FRONT).turn_deg < 0 ? SIDE_LEFT : SIDE_RIGHT));

    brain.memory.cell[PATTERN_FRONT_RIGHT | PATTERN_FRONT] = known;
    brain.changed = false;
    next(FRONT);
    TEST_ASSERT_NOT_EQUAL(0, brain.memory.cell[PATTERN_FRONT_LEFT]);
    TEST_ASSERT_TRUE(brain.changed);
}
