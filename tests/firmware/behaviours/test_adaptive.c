#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_ADAPTIVE);
}

enum { LEFT_1 = 5, LEFT_2 = 9, LEFT_3 = 13 };   /* left, with that confidence */

TEST(a_lesson_has_confidence_1_and_a_clear_way_adds_1)
{
    next(ALL_THREE);
    next(FRONT);
    TEST_ASSERT_EQUAL(1, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
    next(CLEAR);
    TEST_ASSERT_EQUAL(2, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
}

TEST(confidence_ends_at_3)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_3;
    next(FRONT);
    next(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(LEFT_3, brain.memory.cell[PATTERN_FRONT]);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(boredom_takes_a_confidence_of_2)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_3;
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(LEFT_1, brain.memory.cell[PATTERN_FRONT]);
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_FRONT]);
}

TEST(a_cell_that_was_not_used_is_not_judged)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_2;
    brain.memory.cell[PATTERN_ALL_THREE] = LEFT_2;
    remembered_turns(10);
    next(FRONT);
    next(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(LEFT_2, brain.memory.cell[PATTERN_ALL_THREE]);
}

TEST(a_frozen_brain_neither_praises_nor_blames)
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

TEST(a_frozen_brain_learns_nothing_from_a_trial_that_helped)
{
    brain.frozen = true;
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE).reason);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_ALL_THREE]);
    TEST_ASSERT_EQUAL_UINT8(0, brain.used);
    TEST_ASSERT_FALSE(brain.changed);
}
