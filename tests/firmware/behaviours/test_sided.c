#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_SIDED);
}

TEST(a_trial_that_helps_beside_an_obstacle_is_remembered)
{
    next(FRONT_RIGHT);
    next(CLEAR);
    TEST_ASSERT_NOT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_FRONT_RIGHT));
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(a_lesson_of_each_pattern_with_a_side_is_taken_and_of_no_other)
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

TEST(what_a_person_teaches_it_for_a_pattern_without_a_side_is_done)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    assert_action(REASON_REMEMBERED, -10, 0, next(FRONT));
    assert_action(REASON_REMEMBERED, -10, 0, next(FRONT));
}

TEST(boredom_strikes_it_as_the_article_has_it)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

TEST(a_run_with_sided_stores_what_it_learns)
{
    TEST_ASSERT_TRUE(brain.learns);
}
