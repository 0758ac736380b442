/* What happens where it remembers again and again: the count of remembered turns. */
#include "brain_rig.h"

enum { MANY = 2000 };

void setUp(void)
{
    begin(PROFILE_ARTICLE);
    learned(PATTERN_FRONT, SIDE_LEFT);
}

void tearDown(void) {}

static void test_nine_remembered_turns_do_not_bore(void)
{
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
}

static void test_the_tenth_remembered_turn_bores(void)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

/* The count is reset only where the way is clear: the eleventh turn is not the first of a new ten. */
static void test_a_bored_robot_turns_about_once(void)
{
    remembered_turns(10);
    next(FRONT);
    remembered_turns(MANY);
}

static void test_it_turns_about_even_where_the_way_is_clear_by_then(void)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(CLEAR).reason);
}

static void test_a_clear_way_ends_the_count(void)
{
    remembered_turns(9);
    next(CLEAR);
    next(FRONT);   /* looks around */
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

static void test_a_trial_does_not_end_the_count(void)
{
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT_RIGHT).reason);
    remembered_turns(1);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

static void test_the_count_stays_at_255(void)
{
    remembered_turns(10);
    next(FRONT);
    remembered_turns(300);
    TEST_ASSERT_EQUAL_UINT8(255, brain.repeat_count);
}

static void test_the_greatest_limit_bores_once(void)
{
    config_set(&config, BOREDOM_LIMIT, 254);
    remembered_turns(254);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    remembered_turns(MANY);
}

static void test_a_start_ends_the_count(void)
{
    remembered_turns(9);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nine_remembered_turns_do_not_bore);
    RUN_TEST(test_the_tenth_remembered_turn_bores);
    RUN_TEST(test_a_bored_robot_turns_about_once);
    RUN_TEST(test_it_turns_about_even_where_the_way_is_clear_by_then);
    RUN_TEST(test_a_clear_way_ends_the_count);
    RUN_TEST(test_a_trial_does_not_end_the_count);
    RUN_TEST(test_the_count_stays_at_255);
    RUN_TEST(test_the_greatest_limit_bores_once);
    RUN_TEST(test_a_start_ends_the_count);
    return UNITY_END();
}
