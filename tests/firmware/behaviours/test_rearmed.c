#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_REARMED);
}

TEST(boredom_strikes_again_after_ten_more_turns)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    for (unsigned i = 0; i < 3; i++) {
        remembered_turns(10);
        TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
        TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
    }
}

TEST(it_learns_as_the_article_does)
{
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_NOT_EQUAL_INT(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_TRUE(brain.learns);
}

TEST(bored_it_keeps_what_it_knows)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT));
}
