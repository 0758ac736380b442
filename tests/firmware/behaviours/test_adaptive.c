#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_ADAPTIVE);
}

void tearDown(void) {}

enum { LEFT_1 = 5, LEFT_2 = 9, LEFT_3 = 13 };   /* left, with that confidence */

static void test_a_lesson_has_confidence_1_and_a_clear_way_adds_1(void)
{
    next(ALL_THREE);
    next(FRONT);
    TEST_ASSERT_EQUAL(1, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
    next(CLEAR);
    TEST_ASSERT_EQUAL(2, brain.memory.cell[PATTERN_ALL_THREE] >> 2);
}

static void test_confidence_ends_at_3(void)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_3;
    next(FRONT);
    next(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(LEFT_3, brain.memory.cell[PATTERN_FRONT]);
    TEST_ASSERT_FALSE(brain.changed);
}

static void test_boredom_takes_a_confidence_of_2(void)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_3;
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(LEFT_1, brain.memory.cell[PATTERN_FRONT]);
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_FRONT]);
}

static void test_a_cell_that_was_not_used_is_not_judged(void)
{
    brain.memory.cell[PATTERN_FRONT] = LEFT_2;
    brain.memory.cell[PATTERN_ALL_THREE] = LEFT_2;
    remembered_turns(10);
    next(FRONT);
    next(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(LEFT_2, brain.memory.cell[PATTERN_ALL_THREE]);
}

static void test_a_frozen_brain_neither_praises_nor_blames(void)
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

static void test_a_frozen_brain_learns_nothing_from_a_trial_that_helped(void)
{
    brain.frozen = true;
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE).reason);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, brain.memory.cell[PATTERN_ALL_THREE]);
    TEST_ASSERT_EQUAL_UINT8(0, brain.used);
    TEST_ASSERT_FALSE(brain.changed);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_lesson_has_confidence_1_and_a_clear_way_adds_1);
    RUN_TEST(test_confidence_ends_at_3);
    RUN_TEST(test_boredom_takes_a_confidence_of_2);
    RUN_TEST(test_a_cell_that_was_not_used_is_not_judged);
    RUN_TEST(test_a_frozen_brain_neither_praises_nor_blames);
    RUN_TEST(test_a_frozen_brain_learns_nothing_from_a_trial_that_helped);
    return UNITY_END();
}
