#include "brain_rig.h"

#include "firmware/memory/memory.h"

static const uint8_t PROGRAMMED[CELL_COUNT] = {0, 1, 1, 1, 2, 1, 2, 1};

BEFORE_EACH(fixed)
{
    begin(PROFILE_FIXED);
}

TEST(fixed_starts_with_the_programmed_turns)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(PROGRAMMED, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(start_of_fixed_overwrites_the_memory)
{
    memory_learn(&brain.memory, 1, SIDE_RIGHT);
    brain_start(&brain, PROFILE_FIXED, 1);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(PROGRAMMED, brain.memory.cell, CELL_COUNT);
}

TEST(fixed_has_a_turn_for_every_pattern)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        struct action action = next((uint8_t)(pattern << 1));

        TEST_ASSERT_EQUAL(REASON_REMEMBERED, action.reason);
        TEST_ASSERT_EQUAL(PROGRAMMED[pattern] == SIDE_LEFT ? -10 : 10, action.turn_deg);
    }
}

TEST(fixed_uses_a_written_cell)
{
    TEST_ASSERT_TRUE(memory_write(&brain.memory, MEMORY_KIND_SIDES, 1u << 1, SIDE_RIGHT << 8));
    TEST_ASSERT_EQUAL(10, next(FRONT_RIGHT).turn_deg);
}

TEST(fixed_tries_an_erased_cell_without_learning)
{
    memory_erase(&brain.memory);
    brain.changed = false;
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE).reason);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(fixed_is_bored_like_the_article)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

TEST(fixed_stores_no_memory)
{
    TEST_ASSERT_FALSE(brain.learns);
}

BEFORE_EACH(rearmed)
{
    begin(PROFILE_REARMED);
}

TEST(boredom_recurs_after_ten_more_turns)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    for (unsigned i = 0; i < 3; i++) {
        remembered_turns(10);
        TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
        TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
    }
}

TEST(trial_between_remembered_turns_keeps_the_count)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT_LEFT).reason);
    remembered_turns(1);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

TEST(rearmed_learns_like_the_article)
{
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_NOT_EQUAL_INT(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_TRUE(brain.learns);
}

TEST(rearmed_keeps_its_memory_at_boredom)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT));
}

BEFORE_EACH(recheck)
{
    begin(PROFILE_RECHECK);
}

TEST(recheck_empties_a_cell_that_frees_no_sensor)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    next(FRONT);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(recheck_keeps_a_cell_that_frees_a_sensor)
{
    teach(PATTERN_ALL_THREE, SIDE_LEFT);
    next(ALL_THREE);
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(recheck_judges_the_turn_before_boredom)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    brain.repeat_count = 9;
    next(FRONT);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

TEST(frozen_recheck_brain_keeps_its_memory)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    brain.frozen = true;
    remembered_turns(3);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT));
}

TEST(recheck_stores_its_memory)
{
    TEST_ASSERT_TRUE(brain.learns);
}

BEFORE_EACH(sided)
{
    begin(PROFILE_SIDED);
}

TEST(sided_learns_from_a_trial_beside_an_obstacle)
{
    next(FRONT_RIGHT);
    next(CLEAR);
    TEST_ASSERT_NOT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT_RIGHT));
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(sided_learns_only_patterns_with_a_side)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        bool has_a_side = pattern == 1 || pattern == 3 || pattern == 4 || pattern == 6;

        begin(PROFILE_SIDED);
        next((uint8_t)(pattern << 1));
        next(CLEAR);
        TEST_ASSERT_EQUAL(has_a_side, memory_recall(&brain.memory, pattern) != SIDE_NOTHING);
        TEST_ASSERT_EQUAL(has_a_side, brain.changed);
    }
}

TEST(sided_uses_a_written_cell_without_a_side)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    assert_action(REASON_REMEMBERED, -10, 0, next(FRONT));
    assert_action(REASON_REMEMBERED, -10, 0, next(FRONT));
}

TEST(sided_is_bored_like_the_article)
{
    teach(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

TEST(sided_stores_its_memory)
{
    TEST_ASSERT_TRUE(brain.learns);
}

BEFORE_EACH(five)
{
    begin(PROFILE_FIVE);
}

TEST(five_profile_distinguishes_readings_by_side_sensors)
{
    next(ALL_THREE);
    next(CLEAR);   /* it helped */
    next(CLEAR);   /* looks around */
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(ALL_THREE).reason);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE | FEEL_LEFT).reason);
}

TEST(side_sensors_alone_do_not_block_the_way)
{
    TEST_ASSERT_EQUAL(REASON_WANDER, next(FEEL_LEFT | FEEL_RIGHT).reason);
}

TEST(five_profile_trial_ignores_side_sensors)
{
    next(FRONT | FEEL_LEFT | FEEL_RIGHT);
    next(FRONT);
    TEST_ASSERT_FALSE(brain.changed);
}

static void bore(void)
{
    for (unsigned i = 1; i <= 11; i++)
        TEST_ASSERT_EQUAL(i == 11 ? REASON_BOREDOM : REASON_REMEMBERED, next(FRONT).reason);
}

TEST(boredom_of_five_recurs)
{
    for (unsigned i = 0; i < 2; i++) {
        feel_memory_learn(&brain.memory, FRONT, SIDE_LEFT);
        bore();
    }
}

TEST(boredom_of_five_empties_readings_with_the_same_front)
{
    feel_memory_learn(&brain.memory, FRONT, SIDE_LEFT);
    feel_memory_learn(&brain.memory, FRONT | FEEL_LEFT, SIDE_RIGHT);
    feel_memory_learn(&brain.memory, ALL_THREE, SIDE_RIGHT);
    bore();
    TEST_ASSERT_TRUE(brain.changed);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, feel_memory_recall(&brain.memory, FRONT));
    TEST_ASSERT_EQUAL(SIDE_NOTHING, feel_memory_recall(&brain.memory, FRONT | FEEL_LEFT));
    TEST_ASSERT_EQUAL(SIDE_RIGHT, feel_memory_recall(&brain.memory, ALL_THREE));
}

TEST(frozen_five_brain_keeps_its_memory)
{
    feel_memory_learn(&brain.memory, FRONT, SIDE_LEFT);
    brain.frozen = true;
    bore();
    bore();
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(frozen_five_brain_does_not_learn)
{
    brain.frozen = true;
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_FALSE(brain.changed);
    TEST_ASSERT_EACH_EQUAL_HEX8(0, brain.memory.cell, CELL_COUNT);
}

TEST(five_profile_marks_the_memory_as_changed_by_a_lesson)
{
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_TRUE(brain.changed);
    TEST_ASSERT_TRUE(brain.learns);
}
