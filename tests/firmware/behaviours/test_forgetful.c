#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_FORGETFUL);
}

TEST(bored_it_forgets_what_it_has_used)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    learned(PATTERN_FRONT_RIGHT, SIDE_LEFT);
    learned(PATTERN_ALL_THREE, SIDE_LEFT);
    next(FRONT_RIGHT);
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT_RIGHT));
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(what_led_to_a_clear_way_is_not_forgotten)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    learned(PATTERN_FRONT_RIGHT, SIDE_LEFT);
    next(FRONT_RIGHT);
    next(CLEAR);
    next(FRONT);   /* looks around */
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT_RIGHT));
}

TEST(a_lesson_just_learned_is_forgotten_too)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    next(ALL_THREE);
    remembered_turns(10);
    TEST_ASSERT_NOT_EQUAL_INT(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_ALL_THREE));
}

TEST(bored_it_begins_to_count_anew)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}

TEST(it_knows_what_boredom_has_emptied)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    TEST_ASSERT_EQUAL_HEX8(0, brain.unlearned);
    next(FRONT);
    TEST_ASSERT_EQUAL_HEX8(1u << PATTERN_FRONT, brain.unlearned);
}

TEST(what_a_person_has_emptied_was_not_boredom)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    memory_erase(&brain.memory);
    next(FRONT);
    TEST_ASSERT_EQUAL_HEX8(0, brain.unlearned);
}

TEST(a_frozen_brain_forgets_nothing)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    brain.frozen = true;
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT));
    TEST_ASSERT_FALSE(brain.changed);
    TEST_ASSERT_EQUAL_HEX8(0, brain.unlearned);
}

TEST(its_cells_have_no_confidence)
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

TEST(a_run_begins_with_no_cell_used)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    learned(PATTERN_ALL_THREE, SIDE_LEFT);
    next(ALL_THREE);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_FORGETFUL, 1));
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_ALL_THREE));
}
