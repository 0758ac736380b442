/* Where the way is blocked: what it remembers, what it tries, and what a trial teaches. */
#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_ARTICLE);
}

void tearDown(void) {}

static void test_a_cell_with_left_turns_left(void)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        learned(pattern, SIDE_LEFT);
        assert_action(REASON_REMEMBERED, -10, 0, next((uint8_t)(pattern << 1)));
    }
}

static void test_a_cell_with_right_turns_right(void)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        learned(pattern, SIDE_RIGHT);
        assert_action(REASON_REMEMBERED, 10, 0, next((uint8_t)(pattern << 1)));
    }
}

static void test_an_empty_cell_is_tried_by_45_degrees(void)
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

static void test_a_trial_that_frees_a_sensor_is_remembered_for_the_old_pattern(void)
{
    for (unsigned i = 0; i < 20; i++) {
        enum side tried;

        memory_erase(&brain.memory);
        tried = side_of(next(ALL_THREE));
        next(FRONT | FRONT_LEFT);
        TEST_ASSERT_EQUAL(tried, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    }
}

static void test_a_trial_changes_no_other_cell(void)
{
    next(ALL_THREE);
    next(FRONT);
    for (uint8_t pattern = 0; pattern < PATTERN_ALL_THREE; pattern++)
        TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, pattern));
}

static void test_a_trial_that_frees_no_sensor_is_forgotten(void)
{
    next(FRONT);
    next(FRONT_LEFT);   /* another pattern, but as many */
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

static void test_a_trial_that_makes_it_worse_is_forgotten(void)
{
    next(FRONT);
    next(ALL_THREE);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

static void test_the_side_sensors_do_not_judge_a_trial(void)
{
    next(FRONT | FRONT_LEFT);
    next(FRONT | 1 | 16);
    TEST_ASSERT_NOT_EQUAL_INT(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT | PATTERN_FRONT_LEFT));
}

static void test_the_reading_that_judges_a_trial_decides_the_next_action(void)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    next(ALL_THREE);
    assert_action(REASON_REMEMBERED, -10, 0, next(FRONT));
}

static void test_a_trial_is_judged_by_the_first_reading_only(void)
{
    learned(PATTERN_FRONT_LEFT, SIDE_RIGHT);
    next(FRONT);
    next(FRONT_LEFT);   /* no fewer */
    next(CLEAR);        /* fewer, but by the remembered turn */
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

static void test_learning_marks_the_memory_as_changed(void)
{
    next(FRONT);
    TEST_ASSERT_FALSE(brain.changed);
    next(CLEAR);
    TEST_ASSERT_TRUE(brain.changed);
}

static void test_a_trial_in_vain_leaves_the_memory_unchanged(void)
{
    next(FRONT);
    next(FRONT);
    TEST_ASSERT_FALSE(brain.changed);
}

static void test_a_frozen_brain_learns_nothing(void)
{
    brain.frozen = true;
    next(FRONT);
    next(CLEAR);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_FALSE(brain.changed);
}

static void test_a_frozen_brain_uses_what_it_knows(void)
{
    brain.frozen = true;
    learned(PATTERN_FRONT, SIDE_RIGHT);
    assert_action(REASON_REMEMBERED, 10, 0, next(FRONT));
}

static void test_a_start_keeps_what_was_learned(void)
{
    learned(PATTERN_FRONT, SIDE_RIGHT);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    assert_action(REASON_REMEMBERED, 10, 0, next(FRONT));
}

static void test_a_start_forgets_the_trial_under_way(void)
{
    next(FRONT);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    next(CLEAR);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_cell_with_left_turns_left);
    RUN_TEST(test_a_cell_with_right_turns_right);
    RUN_TEST(test_an_empty_cell_is_tried_by_45_degrees);
    RUN_TEST(test_a_trial_that_frees_a_sensor_is_remembered_for_the_old_pattern);
    RUN_TEST(test_a_trial_changes_no_other_cell);
    RUN_TEST(test_a_trial_that_frees_no_sensor_is_forgotten);
    RUN_TEST(test_a_trial_that_makes_it_worse_is_forgotten);
    RUN_TEST(test_the_side_sensors_do_not_judge_a_trial);
    RUN_TEST(test_the_reading_that_judges_a_trial_decides_the_next_action);
    RUN_TEST(test_a_trial_is_judged_by_the_first_reading_only);
    RUN_TEST(test_learning_marks_the_memory_as_changed);
    RUN_TEST(test_a_trial_in_vain_leaves_the_memory_unchanged);
    RUN_TEST(test_a_frozen_brain_learns_nothing);
    RUN_TEST(test_a_frozen_brain_uses_what_it_knows);
    RUN_TEST(test_a_start_keeps_what_was_learned);
    RUN_TEST(test_a_start_forgets_the_trial_under_way);
    return UNITY_END();
}
