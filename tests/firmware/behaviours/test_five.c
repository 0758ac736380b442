#include "brain_rig.h"

#include "firmware/memory/memory.h"

void setUp(void)
{
    begin(PROFILE_FIVE);
}

TEST(the_side_sensors_tell_readings_apart)
{
    next(ALL_THREE);
    next(CLEAR);   /* it helped */
    next(CLEAR);   /* looks around */
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(ALL_THREE).reason);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE | FEEL_LEFT).reason);
}

TEST(the_side_sensors_alone_are_not_in_the_way)
{
    TEST_ASSERT_EQUAL(REASON_WANDER, next(FEEL_LEFT | FEEL_RIGHT).reason);
}

TEST(the_side_sensors_do_not_judge_a_trial)
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

TEST(boredom_can_strike_again)
{
    for (unsigned i = 0; i < 2; i++) {
        feel_memory_learn(&brain.memory, FRONT, SIDE_LEFT);
        bore();
    }
}

TEST(boredom_forgets_what_was_in_front_whatever_was_beside_it)
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

TEST(a_frozen_brain_forgets_nothing_when_it_is_bored)
{
    feel_memory_learn(&brain.memory, FRONT, SIDE_LEFT);
    brain.frozen = true;
    bore();
    bore();
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(a_frozen_brain_learns_nothing)
{
    brain.frozen = true;
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_FALSE(brain.changed);
    TEST_ASSERT_EACH_EQUAL_HEX8(0, brain.memory.cell, CELL_COUNT);
}

TEST(a_trial_that_helped_is_a_change)
{
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_TRUE(brain.changed);
    TEST_ASSERT_TRUE(brain.learns);
}
