/* Where the way is clear: steps, looks and meals. */
#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_ARTICLE);
}

TEST(clear_way_is_driven_one_step)
{
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}

TEST(step_with_visible_food_is_toward_food)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 500));
}

TEST(step_without_visible_food_is_followed_by_a_look_around)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
}

/* The listing does not read the sensors between the step and the look. */
TEST(look_around_follows_a_step_that_met_an_obstacle)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(FRONT).reason);
}

TEST(food_within_reach_is_eaten)
{
    next_seeing_food(CLEAR, 155);
    assert_action(REASON_EAT, 0, 0, next_seeing_food(CLEAR, 149));
}

TEST(food_out_of_reach_is_driven_to)
{
    next_seeing_food(CLEAR, 163);
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 151));
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 150));
}

TEST(food_is_eaten_only_after_a_step)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 100));
}

TEST(food_is_eaten_when_the_step_met_an_obstacle)
{
    next_seeing_food(CLEAR, 155);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(FRONT, 149).reason);
}

TEST(robot_steps_on_after_eating)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}

/* Where the way is blocked: what it remembers, what it tries, and what a trial teaches. */

TEST(cell_with_left_turns_left)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        teach(pattern, SIDE_LEFT);
        assert_action(REASON_REMEMBERED, -10, 0, next((uint8_t)(pattern << 1)));
    }
}

TEST(cell_with_right_turns_right)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        teach(pattern, SIDE_RIGHT);
        assert_action(REASON_REMEMBERED, 10, 0, next((uint8_t)(pattern << 1)));
    }
}

TEST(empty_cell_starts_a_trial_of_45_degrees)
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

TEST(trial_that_frees_a_sensor_is_learned_for_the_old_pattern)
{
    for (unsigned i = 0; i < 20; i++) {
        enum side tried;

        memory_erase(&brain.memory);
        tried = side_of(next(ALL_THREE));
        next(FRONT | FRONT_LEFT);
        TEST_ASSERT_EQUAL(tried, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    }
}

TEST(trial_changes_only_its_own_cell)
{
    next(ALL_THREE);
    next(FRONT);
    for (uint8_t pattern = 0; pattern < PATTERN_ALL_THREE; pattern++)
        TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, pattern));
}

TEST(trial_that_frees_no_sensor_is_not_learned)
{
    next(FRONT);
    next(FRONT_LEFT);   /* another pattern, but as many */
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

TEST(trial_that_triggers_more_sensors_is_not_learned)
{
    next(FRONT);
    next(ALL_THREE);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

TEST(article_trial_ignores_side_sensors)
{
    next(FRONT | FRONT_LEFT);
    next(FRONT | 1 | 16);
    TEST_ASSERT_NOT_EQUAL_INT(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT | PATTERN_FRONT_LEFT));
}

TEST(trial_is_judged_by_the_reading_of_the_next_action)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    next(ALL_THREE);
    assert_action(REASON_REMEMBERED, -10, 0, next(FRONT));
}

TEST(trial_is_judged_by_the_first_reading_only)
{
    teach(PATTERN_FRONT_LEFT, SIDE_RIGHT);
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

TEST(unsuccessful_trial_leaves_the_memory_unchanged)
{
    next(FRONT);
    next(FRONT);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(frozen_article_brain_does_not_learn)
{
    brain.frozen = true;
    next(FRONT);
    next(CLEAR);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(frozen_brain_uses_its_memory)
{
    brain.frozen = true;
    teach(PATTERN_FRONT, SIDE_RIGHT);
    assert_action(REASON_REMEMBERED, 10, 0, next(FRONT));
}

TEST(start_keeps_the_memory)
{
    teach(PATTERN_FRONT, SIDE_RIGHT);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    assert_action(REASON_REMEMBERED, 10, 0, next(FRONT));
}

TEST(start_discards_the_pending_trial)
{
    next(FRONT);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    next(CLEAR);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}
