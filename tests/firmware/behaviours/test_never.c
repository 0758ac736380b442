#include "brain_rig.h"

#include "firmware/memory/memory.h"

enum { MANY = 100 };

static const uint8_t REMEMBERED[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 1};

/* A robot that knows something from before. */
void setUp(void)
{
    begin(PROFILE_NEVER);
    TEST_ASSERT_TRUE(memory_adopt(&brain.memory, REMEMBERED));
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_NEVER, 1));
}

TEST(every_blockage_is_a_trial)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        struct action action = next((uint8_t)(pattern << 1));

        TEST_ASSERT_EQUAL(REASON_TRIAL, action.reason);
        TEST_ASSERT_TRUE(action.turn_deg == -45 || action.turn_deg == 45);
    }
}

TEST(a_trial_that_helps_teaches_nothing)
{
    for (unsigned i = 0; i < MANY; i++) {
        next(ALL_THREE);
        next(CLEAR);
        next(CLEAR);   /* looks around */
    }
    TEST_ASSERT_EQUAL_UINT8_ARRAY(REMEMBERED, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(every_tenth_trial_in_a_row_is_a_bigger_turn)
{
    for (unsigned i = 1; i <= MANY; i++) {
        struct action action = next(ALL_THREE);

        TEST_ASSERT_EQUAL(i % 10 == 0 ? REASON_BOREDOM : REASON_TRIAL, action.reason);
        TEST_ASSERT_TRUE(i % 10 != 0 || action.turn_deg == -150 || action.turn_deg == 150);
        TEST_ASSERT_EQUAL_UINT8(i % 10, brain.repeat_count);
    }
}

TEST(a_clear_way_ends_the_trials_in_a_row)
{
    for (unsigned i = 1; i < 10; i++)
        next(ALL_THREE);
    next(CLEAR);
    next(CLEAR);   /* looks around */
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE).reason);
}

TEST(it_leaves_the_memory_as_it_is)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(REMEMBERED, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_FALSE(brain.changed);
    TEST_ASSERT_FALSE(brain.learns);
}

TEST(the_bigger_turn_is_to_the_side_that_is_drawn)
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

TEST(only_trials_are_counted)
{
    for (unsigned i = 0; i < MANY; i++)
        TEST_ASSERT_NOT_EQUAL_INT(REASON_BOREDOM, next(CLEAR).reason);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}

TEST(a_limit_that_is_lowered_meanwhile_counts_at_once)
{
    for (unsigned i = 0; i < 8; i++)
        next(ALL_THREE);
    config.value[BOREDOM_LIMIT] = 5;
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(ALL_THREE).reason);
}

TEST(a_meal_is_no_trial)
{
    begin(PROFILE_NEVER);
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(CLEAR, 1).reason);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}
