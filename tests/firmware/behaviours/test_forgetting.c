#include "brain_rig.h"

#include "firmware/memory/memory.h"

BEFORE_EACH(adaptive)
{
    begin(PROFILE_ADAPTIVE);
}

enum { LEFT_1 = 5, LEFT_2 = 9, LEFT_3 = 13 };   /* left, with that confidence */

TEST(lesson_has_confidence_1_and_clear_way_adds_1)
{
    next(ALL_THREE);
    next(FRONT);
    TEST_ASSERT_EQUAL(1, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
    next(CLEAR);
    TEST_ASSERT_EQUAL(2, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
}

TEST(lesson_gains_no_confidence_for_other_cells)
{
    brain.memory.cell[PATTERN_FRONT_LEFT] = LEFT_1;
    next(FRONT | FRONT_RIGHT);
    next(FRONT);   /* has learned */
    next(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(LEFT_1, brain.memory.cell[PATTERN_FRONT_LEFT]);
}

TEST(confidence_saturates_at_3)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_3;
    next(FRONT);
    next(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(LEFT_3, brain.memory.cell[PATTERN_FRONT]);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(boredom_reduces_confidence_by_2)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_3;
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(LEFT_1, brain.memory.cell[PATTERN_FRONT]);
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_FRONT]);
}

TEST(unused_cell_keeps_its_confidence)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_2;
    brain.memory.cell[PATTERN_ALL_THREE] = LEFT_2;
    remembered_turns(10);
    next(FRONT);
    next(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(LEFT_2, brain.memory.cell[PATTERN_ALL_THREE]);
}

TEST(frozen_brain_keeps_confidences)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_2;
    brain.frozen = true;
    remembered_turns(1);
    next(CLEAR);
    next(FRONT);   /* looks around */
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(LEFT_2, brain.memory.cell[PATTERN_FRONT]);
}

TEST(frozen_adaptive_brain_does_not_learn)
{
    brain.frozen = true;
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE).reason);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_ALL_THREE]);
    TEST_ASSERT_EQUAL_UINT8(0, brain.used);
    TEST_ASSERT_FALSE(brain.changed);
}

BEFORE_EACH(forgetful)
{
    begin(PROFILE_FORGETFUL);
}

TEST(boredom_empties_the_cells_used)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    teach(PATTERN_FRONT_RIGHT, SIDE_LEFT);
    teach(PATTERN_ALL_THREE, SIDE_LEFT);
    next(FRONT_RIGHT);
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT_RIGHT));
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(boredom_keeps_cells_that_led_to_a_clear_way)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    teach(PATTERN_FRONT_RIGHT, SIDE_LEFT);
    next(FRONT_RIGHT);
    next(CLEAR);
    next(FRONT);   /* looks around */
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT_RIGHT));
}

TEST(boredom_empties_a_cell_just_learned)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    next(ALL_THREE);
    remembered_turns(10);
    TEST_ASSERT_NOT_EQUAL_INT(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_ALL_THREE));
}

TEST(boredom_resets_the_repeat_count)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}

TEST(brain_records_the_cells_that_boredom_emptied)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    TEST_ASSERT_EQUAL_HEX8(0, brain.unlearned);
    next(FRONT);
    TEST_ASSERT_EQUAL_HEX8(1u << PATTERN_FRONT, brain.unlearned);
}

TEST(cells_erased_before_boredom_are_not_recorded)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    memory_erase(&brain.memory);
    next(FRONT);
    TEST_ASSERT_EQUAL_HEX8(0, brain.unlearned);
}

TEST(frozen_forgetful_brain_keeps_its_memory)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    brain.frozen = true;
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_FALSE(brain.changed);
    TEST_ASSERT_EQUAL_HEX8(0, brain.unlearned);
}

TEST(forgetful_cells_have_no_confidence)
{
    TEST_ASSERT_TRUE(brain.learns);
    next(ALL_THREE);
    next(CLEAR);
    next(CLEAR);   /* looks around */
    next(ALL_THREE);
    next(CLEAR);   /* the turn that it remembered led to a clear way */
    TEST_ASSERT_TRUE(brain.memory.cell[PATTERN_ALL_THREE] == SIDE_LEFT
                     || brain.memory.cell[PATTERN_ALL_THREE] == SIDE_RIGHT);
}

TEST(start_clears_the_used_cells)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    teach(PATTERN_ALL_THREE, SIDE_LEFT);
    next(ALL_THREE);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_FORGETFUL, 1));
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_ALL_THREE));
}

enum { MANY = 100 };

static const uint8_t REMEMBERED[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 1};

/* A robot that knows something from before. */
BEFORE_EACH(never)
{
    begin(PROFILE_NEVER);
    TEST_ASSERT_TRUE(memory_adopt(&brain.memory, REMEMBERED));
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_NEVER, 1));
}

TEST(never_profile_makes_a_trial_at_every_pattern)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        struct action action = next((uint8_t)(pattern << 1));

        TEST_ASSERT_EQUAL(REASON_TRIAL, action.reason);
        TEST_ASSERT_TRUE(action.turn_deg == -45 || action.turn_deg == 45);
    }
}

TEST(never_profile_does_not_learn_from_trials)
{
    for (unsigned i = 0; i < MANY; i++) {
        next(ALL_THREE);
        next(CLEAR);
        next(CLEAR);   /* looks around */
    }
    TEST_ASSERT_EQUAL_UINT8_ARRAY(REMEMBERED, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(tenth_trial_in_a_row_turns_150_degrees)
{
    for (unsigned i = 1; i <= MANY; i++) {
        struct action action = next(ALL_THREE);

        TEST_ASSERT_EQUAL(i % 10 == 0 ? REASON_BOREDOM : REASON_TRIAL, action.reason);
        TEST_ASSERT_TRUE(i % 10 != 0 || action.turn_deg == -150 || action.turn_deg == 150);
        TEST_ASSERT_EQUAL_UINT8(i % 10, brain.repeat_count);
    }
}

TEST(clear_way_resets_the_trial_count)
{
    for (unsigned i = 1; i < 10; i++)
        next(ALL_THREE);
    next(CLEAR);
    next(CLEAR);   /* looks around */
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE).reason);
}

TEST(never_profile_leaves_the_memory_unchanged)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(REMEMBERED, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_FALSE(brain.changed);
    TEST_ASSERT_FALSE(brain.learns);
}

TEST(turn_of_150_degrees_is_to_the_drawn_side)
{
    unsigned turns = 0;

    while (turns < 20) {
        struct random dice = brain.random;
        bool right = random_below(&dice, 2) + 1 == SIDE_RIGHT;
        struct action action = next(ALL_THREE);

        TEST_ASSERT_EQUAL(right, action.turn_deg > 0);
        turns += action.reason == REASON_BOREDOM;
    }
}

TEST(steps_are_not_counted_as_trials)
{
    for (unsigned i = 0; i < MANY; i++)
        TEST_ASSERT_NOT_EQUAL_INT(REASON_BOREDOM, next(CLEAR).reason);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}

TEST(lowered_boredom_limit_applies_at_once)
{
    for (unsigned i = 0; i < 8; i++)
        next(ALL_THREE);
    config.value[BOREDOM_LIMIT] = 5;
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(ALL_THREE).reason);
}

TEST(meal_is_not_counted_as_a_trial)
{
    begin(PROFILE_NEVER);
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(CLEAR, 1).reason);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}
