/* What happens where it remembers again and again: the count of remembered turns. */
#include "brain_rig.h"

enum { MANY = 2000 };

void setUp(void)
{
    begin(PROFILE_ARTICLE);
    learned(PATTERN_FRONT, SIDE_LEFT);
}

TEST(nine_remembered_turns_do_not_bore)
{
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
}

TEST(the_tenth_remembered_turn_bores)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

/* The count is reset only where the way is clear: the eleventh turn is not the first of a new ten. */
TEST(a_bored_robot_turns_about_once)
{
    remembered_turns(10);
    next(FRONT);
    remembered_turns(MANY);
}

TEST(it_turns_about_even_where_the_way_is_clear_by_then)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(CLEAR).reason);
}

TEST(a_clear_way_ends_the_count)
{
    remembered_turns(9);
    next(CLEAR);
    next(FRONT);   /* looks around */
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

TEST(a_trial_does_not_end_the_count)
{
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT_RIGHT).reason);
    remembered_turns(1);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

TEST(the_count_stays_at_255)
{
    remembered_turns(10);
    next(FRONT);
    remembered_turns(300);
    TEST_ASSERT_EQUAL_UINT8(255, brain.repeat_count);
}

TEST(the_greatest_limit_bores_once)
{
    config.value[BOREDOM_LIMIT] = 254;
    remembered_turns(254);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    remembered_turns(MANY);
}

TEST(a_start_ends_the_count)
{
    remembered_turns(9);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}
