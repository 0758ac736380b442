/* Where the way is clear: steps, looks and meals. */
#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_ARTICLE);
}

TEST(a_clear_way_is_driven_one_step)
{
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}

TEST(a_step_with_food_in_sight_is_toward_it)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 500));
}

TEST(without_food_in_sight_it_looks_around)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
}

/* The listing does not read the sensors between the step and the look. */
TEST(it_looks_around_even_where_the_step_met_an_obstacle)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(FRONT).reason);
}

TEST(food_within_reach_is_eaten)
{
    next_seeing_food(CLEAR, 155);
    assert_action(REASON_EAT, 0, 0, next_seeing_food(CLEAR, 149));
}

TEST(food_just_out_of_reach_is_driven_to)
{
    next_seeing_food(CLEAR, 155);
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 150));
}

TEST(food_is_eaten_only_after_a_step)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 100));
}

TEST(food_is_eaten_even_where_the_step_met_an_obstacle)
{
    next_seeing_food(CLEAR, 155);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(FRONT, 149).reason);
}

TEST(after_eating_it_goes_on)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}

/* Where the way is blocked: what it remembers, what it tries, and what a trial teaches. */

TEST(a_cell_with_left_turns_left)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        learned(pattern, SIDE_LEFT);
        assert_action(REASON_REMEMBERED, -10, 0, next((uint8_t)(pattern << 1)));
    }
}

TEST(a_cell_with_right_turns_right)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        learned(pattern, SIDE_RIGHT);
        assert_action(REASON_REMEMBERED, 10, 0, next((uint8_t)(pattern << 1)));
    }
}

TEST(an_empty_cell_is_tried_by_45_degrees)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        struct action trial = next((uint8_t)(pattern << 1));

        TEST_ASSERT_EQUAL(REASON_TRIAL, trial.reason);
        TEST_ASSERT_TRUE(trial.turn_deg == -45 || trial.turn_deg == 45);
    }
}

static enum side side_of(struct action action)
{
    return action.turn_deg > 0 ? SIDE_RIGHT : SIDE_LEFT;
}

TEST(a_trial_that_frees_a_sensor_is_remembered_for_the_old_pattern)
{
    for (unsigned i = 0; i < 20; i++) {
        enum side tried;

        memory_erase(&brain.memory);
        tried = side_of(next(ALL_THREE));
        next(FRONT | FRONT_LEFT);
        TEST_ASSERT_EQUAL(tried, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    }
}

TEST(a_trial_changes_no_other_cell)
{
    next(ALL_THREE);
    next(FRONT);
    for (uint8_t pattern = 0; pattern < PATTERN_ALL_THREE; pattern++)
        TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, pattern));
}

TEST(a_trial_that_frees_no_sensor_is_forgotten)
{
    next(FRONT);
    next(FRONT_LEFT);   /* another pattern, but as many */
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

TEST(a_trial_that_makes_it_worse_is_forgotten)
{
    next(FRONT);
    next(ALL_THREE);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

TEST(the_side_sensors_do_not_judge_a_trial)
{
    next(FRONT | FRONT_LEFT);
    next(FRONT | 1 | 16);
    TEST_ASSERT_NOT_EQUAL_INT(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT | PATTERN_FRONT_LEFT));
}

TEST(the_reading_that_judges_a_trial_decides_the_next_action)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    next(ALL_THREE);
    assert_action(REASON_REMEMBERED, -10, 0, next(FRONT));
}

TEST(a_trial_is_judged_by_the_first_reading_only)
{
    learned(PATTERN_FRONT_LEFT, SIDE_RIGHT);
    next(FRONT);
    next(FRONT_LEFT);   /* no fewer */
    next(CLEAR);        /* fewer, but by the remembered turn */
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

TEST(learning_marks_the_memory_as_changed)
{
    next(FRONT);
    TEST_ASSERT_FALSE(brain.changed);
    next(CLEAR);
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(a_trial_in_vain_leaves_the_memory_unchanged)
{
    next(FRONT);
    next(FRONT);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(a_frozen_brain_learns_nothing)
{
    brain.frozen = true;
    next(FRONT);
    next(CLEAR);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(a_frozen_brain_uses_what_it_knows)
{
    brain.frozen = true;
    learned(PATTERN_FRONT, SIDE_RIGHT);
    assert_action(REASON_REMEMBERED, 10, 0, next(FRONT));
}

TEST(a_start_keeps_what_was_learned)
{
    learned(PATTERN_FRONT, SIDE_RIGHT);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    assert_action(REASON_REMEMBERED, 10, 0, next(FRONT));
}

TEST(a_start_forgets_the_trial_under_way)
{
    next(FRONT);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    next(CLEAR);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}
