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

TEST(searcher_starts_with_a_full_turn)
{
    assert_turns_once_around();
}

/* The distance driven after the next full turn: 1000 mm, less 8 for each degree beyond 360. */
static unsigned distance_mm(void)
{
    return 1000 - 8 * ((unsigned)abs(next(CLEAR).turn_deg) - 360);
}

TEST(searcher_drives_a_metre_less_8_mm_per_degree_aside)
{
    for (unsigned i = 0; i < 10; i++)
        steps((distance_mm() + 11) / 12);
    assert_turns_once_around();
}

TEST(searcher_drives_to_visible_food)
{
    TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_seeing_food(CLEAR, 900).reason);
    TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_seeing_food(CLEAR, 150).reason);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(CLEAR, 149).reason);
}

TEST(searcher_makes_a_full_turn_after_a_meal)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_turns_once_around();
}

TEST(searcher_drives_200_mm_on_after_losing_food)
{
    next_seeing_food(CLEAR, 900);
    next_seeing_food(CLEAR, 888);   /* still seen: not lost yet */
    steps(17);
    assert_turns_once_around();
}

/* Food that is lost again and again cannot be reached from here. */
TEST(searcher_drives_400_mm_on_after_losing_food_again)
{
    static const unsigned steps_on[] = {17, 34, 34};   /* in steps of 12 mm: 200 mm and on */

    for (unsigned i = 0; i < sizeof steps_on / sizeof steps_on[0]; i++) {
        next_seeing_food(CLEAR, 900);
        steps(steps_on[i]);
        assert_turns_once_around();
    }
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);   /* a meal */
    assert_turns_once_around();
    next_seeing_food(CLEAR, 900);
    steps(steps_on[0]);
    assert_turns_once_around();
}

TEST(searcher_leaves_a_full_turn_0_to_59_degrees_aside)
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

TEST(searcher_learns_like_adaptive)
{
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_EQUAL(2, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
}

TEST(full_turn_resets_the_repeat_count)
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

TEST(searcher_looks_for_lost_food_on_the_obstacle_side)
{
    turn_aside_and_lose_food(SIDE_RIGHT);
    TEST_ASSERT_LESS_OR_EQUAL(-360, next(CLEAR).turn_deg);
    begin(PROFILE_SEARCHER);
    turn_aside_and_lose_food(SIDE_LEFT);
    TEST_ASSERT_GREATER_OR_EQUAL(360, next(CLEAR).turn_deg);
}

TEST(start_resets_the_side_of_the_full_turn)
{
    turn_aside_and_lose_food(SIDE_RIGHT);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, 1));
    next_seeing_food(CLEAR, 900);
    steps(17);
    TEST_ASSERT_GREATER_OR_EQUAL(360, next(CLEAR).turn_deg);
}

TEST(full_turn_is_to_the_right_without_lost_food)
{
    memory_put(&brain.memory, MEMORY_KIND_CONFIDENCE, PATTERN_FRONT, SIDE_RIGHT);
    next(FRONT);
    TEST_ASSERT_GREATER_OR_EQUAL(360, next(CLEAR).turn_deg);
}

/* Tries seeds until a trial is to that side, and lets it help. */
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

TEST(lesson_is_mirrored_to_the_other_side)
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

TEST(lesson_of_a_symmetric_pattern_is_not_mirrored)
{
    static const uint8_t alike[] = {FRONT, FRONT_RIGHT | FRONT_LEFT, ALL_THREE};

    for (unsigned i = 0; i < sizeof alike; i++) {
        learn(alike[i], SIDE_LEFT);
        TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_FRONT_RIGHT]);
        TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_FRONT_LEFT]);
    }
}

TEST(searcher_is_bored_when_the_way_is_clear)
{
    memory_put(&brain.memory, MEMORY_KIND_CONFIDENCE, PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(config.value[BOREDOM_LIMIT]);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(CLEAR).reason);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
}

TEST(searcher_stores_its_memory)
{
    TEST_ASSERT_TRUE(brain.learns);
}

TEST(full_turn_follows_200_mm_after_losing_food)
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

TEST(searcher_steps_toward_food_out_of_reach)
{
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_seeing_food(CLEAR, 900).reason);
}

TEST(searcher_steps_on_after_one_full_turn)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
    TEST_ASSERT_EQUAL(REASON_WANDER, next(CLEAR).reason);
}

TEST(searcher_tries_a_turn_when_a_step_meets_an_obstacle)
{
    assert_turns_once_around();
    steps(1);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
}

TEST(food_seen_at_an_obstacle_restarts_the_distance)
{
    const struct senses blocked = {.feel = FRONT, .look = true, .beacon_mm = 900};

    config.value[STEP_MM] = 111;   /* nine steps are 999 mm */
    assert_turns_once_around();
    steps(1);
    TEST_ASSERT_EQUAL(REASON_TRIAL, brain_next(&brain, &config, &blocked).reason);
    steps(10);
    assert_turns_once_around();
}

TEST(start_discards_the_food_in_sight)
{
    next_seeing_food(CLEAR, 900);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, 1));
    assert_turns_once_around();
}

TEST(start_resets_the_distance_after_lost_food)
{
    next_seeing_food(CLEAR, 900);
    steps(17);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, 1));
    next_seeing_food(CLEAR, 900);
    steps(17);
    assert_turns_once_around();
}

TEST(trial_is_judged_once_when_a_look_around_follows)
{
    next(ALL_THREE);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
    next(FRONT);
    TEST_ASSERT_EQUAL(2, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
}

/* Another robot's vote may have filled the cell during the trial. */
TEST(lesson_in_its_own_cell_is_still_mirrored)
{
    const uint8_t known = (uint8_t)(1u << 2 | (next(FRONT_RIGHT | FRONT).turn_deg < 0 ? SIDE_LEFT : SIDE_RIGHT));

    brain.memory.cell[PATTERN_FRONT_RIGHT | PATTERN_FRONT] = known;
    brain.changed = false;
    next(FRONT);
    TEST_ASSERT_NOT_EQUAL(0, brain.memory.cell[PATTERN_FRONT_LEFT]);
    TEST_ASSERT_TRUE(brain.changed);
}
