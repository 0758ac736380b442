#include "firmware/brain.h"

#include <unity.h>

/* Readings of the front sensors. */
enum { CLEAR = 0, FRONT_RIGHT = 2, FRONT = 4, FRONT_LEFT = 8, ALL_THREE = 14 };
/* The patterns that these are. */
enum { PATTERN_FRONT = 2, PATTERN_FRONT_LEFT = 4, PATTERN_ALL_THREE = 7 };

enum { MANY = 2000 };

static struct brain brain;
static struct config config;

void setUp(void)
{
    brain = (struct brain){.frozen = false};
    config_reset(&config);
    brain_start(&brain, PROFILE_ARTICLE, 1);
}

void tearDown(void) {}

static struct action next(uint8_t feel)
{
    const struct senses senses = {.feel = feel};

    return brain_next(&brain, &config, &senses);
}

static struct action next_seeing_food(uint8_t feel, uint16_t beacon_mm)
{
    const struct senses senses = {.feel = feel, .look = true, .beacon_mm = beacon_mm};

    return brain_next(&brain, &config, &senses);
}

static void learned(uint8_t pattern, enum side side)
{
    memory_learn(&brain.memory, pattern, side);
}

static void assert_action(enum reason reason, int turn_deg, unsigned forward_mm, struct action action)
{
    TEST_ASSERT_EQUAL(reason, action.reason);
    TEST_ASSERT_EQUAL(turn_deg, action.turn_deg);
    TEST_ASSERT_EQUAL(forward_mm, action.forward_mm);
}

static void test_a_clear_way_is_driven_one_step(void)
{
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}

static void test_a_step_with_food_in_sight_is_toward_it(void)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 500));
}

static void test_without_food_in_sight_it_looks_around(void)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
}

/* The listing does not read the sensors between the step and the look. */
static void test_it_looks_around_even_where_the_step_met_an_obstacle(void)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(FRONT).reason);
}

static void test_looking_around_is_by_2_to_11_degrees_either_way(void)
{
    bool seen[23] = {false};   /* -11..11 degrees */

    for (unsigned i = 0; i < MANY; i++) {
        struct action look_around;

        next(CLEAR);
        look_around = next(CLEAR);
        TEST_ASSERT_INT_WITHIN(11, 0, look_around.turn_deg);
        seen[look_around.turn_deg + 11] = true;
    }
    for (int turn_deg = -11; turn_deg <= 11; turn_deg++)
        TEST_ASSERT_EQUAL(turn_deg < -1 || turn_deg > 1, seen[turn_deg + 11]);
}

static void test_either_way_of_looking_around_is_as_likely(void)
{
    unsigned right = 0;

    for (unsigned i = 0; i < MANY; i++) {
        next(CLEAR);
        right += next(CLEAR).turn_deg > 0;
    }
    TEST_ASSERT_UINT_WITHIN(112, MANY / 2, right);   /* five standard deviations */
}

static void test_food_within_reach_is_eaten(void)
{
    next_seeing_food(CLEAR, 155);
    assert_action(REASON_EAT, 0, 0, next_seeing_food(CLEAR, 149));
}

static void test_food_just_out_of_reach_is_driven_to(void)
{
    next_seeing_food(CLEAR, 155);
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 150));
}

static void test_food_is_eaten_only_after_a_step(void)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 100));
}

static void test_food_is_eaten_even_where_the_step_met_an_obstacle(void)
{
    next_seeing_food(CLEAR, 155);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(FRONT, 149).reason);
}

static void test_after_eating_it_goes_on(void)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}

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

static void test_either_way_of_trying_is_as_likely(void)
{
    unsigned right = 0;

    for (unsigned i = 0; i < MANY; i++)
        right += next(FRONT).turn_deg > 0;
    TEST_ASSERT_UINT_WITHIN(112, MANY / 2, right);
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
    TEST_ASSERT_TRUE(memory_recall(&brain.memory, PATTERN_FRONT | PATTERN_FRONT_LEFT) != SIDE_NOTHING);
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

static void remembered_turns(unsigned count)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
}

static void test_nine_remembered_turns_do_not_bore(void)
{
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
}

static void test_the_tenth_remembered_turn_bores(void)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

/* The count is reset only where the way is clear: the eleventh turn is not the first of a new ten. */
static void test_a_bored_robot_turns_about_once(void)
{
    remembered_turns(10);
    next(FRONT);
    remembered_turns(MANY);
}

static void test_it_turns_about_even_where_the_way_is_clear_by_then(void)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(CLEAR).reason);
}

static void test_turning_about_is_by_150_to_209_degrees_to_the_right(void)
{
    bool seen[60] = {false};

    for (unsigned i = 0; i < MANY; i++) {
        int turn_deg;

        next(CLEAR);
        next(CLEAR);
        remembered_turns(10);
        turn_deg = next(FRONT).turn_deg;
        TEST_ASSERT_TRUE(turn_deg >= 150 && turn_deg <= 209);
        seen[turn_deg - 150] = true;
    }
    for (unsigned i = 0; i < 60; i++)
        TEST_ASSERT_TRUE(seen[i]);
}

static void test_a_clear_way_ends_the_count(void)
{
    remembered_turns(9);
    next(CLEAR);
    next(FRONT);   /* looks around */
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

static void test_a_trial_does_not_end_the_count(void)
{
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT_RIGHT).reason);
    remembered_turns(1);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

static void test_the_count_stays_at_255(void)
{
    remembered_turns(10);
    next(FRONT);
    remembered_turns(300);
    TEST_ASSERT_EQUAL_UINT8(255, brain.repeat_count);
}

static void test_the_greatest_limit_bores_once(void)
{
    config_set(&config, BOREDOM_LIMIT, 254);
    remembered_turns(254);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    remembered_turns(MANY);
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

static void test_a_start_ends_the_count(void)
{
    remembered_turns(9);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}

static void test_equal_seeds_make_equal_choices(void)
{
    for (unsigned i = 0; i < 100; i++) {
        int first;

        brain_start(&brain, PROFILE_ARTICLE, i);
        first = next(FRONT).turn_deg;
        brain_start(&brain, PROFILE_ARTICLE, i);
        TEST_ASSERT_EQUAL(first, next(FRONT).turn_deg);
    }
}

static void test_a_step_a_meal_and_a_remembered_turn_draw_no_random_number(void)
{
    const struct random before = brain.random;

    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    remembered_turns(10);
    TEST_ASSERT_EQUAL_MEMORY(&before, &brain.random, sizeof before);
}

/* The article's draws: random(2) is 1 for a look to the right. */
static void test_it_looks_to_the_right_where_the_draw_is_1(void)
{
    for (unsigned i = 0; i < 20; i++) {
        struct random dice;

        next(CLEAR);
        dice = brain.random;
        TEST_ASSERT_EQUAL(random_below(&dice, 2) == 1, next(CLEAR).turn_deg > 0);
    }
}

/* random(2) + 1 is the side: 1 left, 2 right. */
static void test_it_tries_the_side_that_is_drawn(void)
{
    for (unsigned i = 0; i < 20; i++) {
        struct random dice = brain.random;

        TEST_ASSERT_EQUAL(random_below(&dice, 2) + 1 == SIDE_RIGHT, next(FRONT).turn_deg > 0);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_clear_way_is_driven_one_step);
    RUN_TEST(test_a_step_with_food_in_sight_is_toward_it);
    RUN_TEST(test_without_food_in_sight_it_looks_around);
    RUN_TEST(test_it_looks_around_even_where_the_step_met_an_obstacle);
    RUN_TEST(test_looking_around_is_by_2_to_11_degrees_either_way);
    RUN_TEST(test_either_way_of_looking_around_is_as_likely);
    RUN_TEST(test_food_within_reach_is_eaten);
    RUN_TEST(test_food_just_out_of_reach_is_driven_to);
    RUN_TEST(test_food_is_eaten_only_after_a_step);
    RUN_TEST(test_food_is_eaten_even_where_the_step_met_an_obstacle);
    RUN_TEST(test_after_eating_it_goes_on);
    RUN_TEST(test_a_cell_with_left_turns_left);
    RUN_TEST(test_a_cell_with_right_turns_right);
    RUN_TEST(test_an_empty_cell_is_tried_by_45_degrees);
    RUN_TEST(test_either_way_of_trying_is_as_likely);
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
    RUN_TEST(test_nine_remembered_turns_do_not_bore);
    RUN_TEST(test_the_tenth_remembered_turn_bores);
    RUN_TEST(test_a_bored_robot_turns_about_once);
    RUN_TEST(test_it_turns_about_even_where_the_way_is_clear_by_then);
    RUN_TEST(test_turning_about_is_by_150_to_209_degrees_to_the_right);
    RUN_TEST(test_a_clear_way_ends_the_count);
    RUN_TEST(test_a_trial_does_not_end_the_count);
    RUN_TEST(test_the_count_stays_at_255);
    RUN_TEST(test_the_greatest_limit_bores_once);
    RUN_TEST(test_a_start_keeps_what_was_learned);
    RUN_TEST(test_a_start_forgets_the_trial_under_way);
    RUN_TEST(test_a_start_ends_the_count);
    RUN_TEST(test_equal_seeds_make_equal_choices);
    RUN_TEST(test_a_step_a_meal_and_a_remembered_turn_draw_no_random_number);
    RUN_TEST(test_it_looks_to_the_right_where_the_draw_is_1);
    RUN_TEST(test_it_tries_the_side_that_is_drawn);
    return UNITY_END();
}
