#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_REARMED);
}

void tearDown(void) {}

static void test_boredom_strikes_again_after_ten_more_turns(void)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    for (unsigned i = 0; i < 3; i++) {
        remembered_turns(10);
        TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
        TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
    }
}

static void test_it_learns_as_the_article_does(void)
{
    next(ALL_THREE);
    next(CLEAR);
    TEST_ASSERT_NOT_EQUAL_INT(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_TRUE(brain.learns);
}

static void test_bored_it_keeps_what_it_knows(void)
{
    learned(PATTERN_FRONT, SIDE_LEFT);
    remembered_turns(10);
    next(FRONT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&brain.memory, PATTERN_FRONT));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_boredom_strikes_again_after_ten_more_turns);
    RUN_TEST(test_it_learns_as_the_article_does);
    RUN_TEST(test_bored_it_keeps_what_it_knows);
    return UNITY_END();
}
