#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_RECHECK);
}

TEST(a_remembered_turn_that_frees_no_sensor_is_forgotten)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    next(FRONT);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(a_remembered_turn_that_frees_a_sensor_is_kept)
{
    learned(PATTERN_ALL_THREE, SIDE_LEFT);
    next(ALL_THREE);
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(the_turn_before_the_about_face_is_checked_too)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    brain.repeat_count = 9;
    next(FRONT);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
}

TEST(a_frozen_brain_forgets_nothing)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    brain.frozen = true;
    remembered_turns(3);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT));
}

TEST(a_run_with_recheck_stores_what_it_learns)
{
    TEST_ASSERT_TRUE(brain.learns);
}
