/* Where the way is clear: steps, looks and meals. */
#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_ARTICLE);
}

void tearDown(void) {}

static void test_a_clear_way_is_driven_one_step(void)
{
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}

static void test_a_step_with_food_in_sight_is_toward_it(void)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 500));
}

static void test_without_food_in_sight_it_looks_around(void)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
}

/* The listing does not read the sensors between the step and the look. */
static void test_it_looks_around_even_where_the_step_met_an_obstacle(void)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(FRONT).reason);
}

static void test_food_within_reach_is_eaten(void)
{
    next_seeing_food(CLEAR, 155);
    assert_action(REASON_EAT, 0, 0, next_seeing_food(CLEAR, 149));
}

static void test_food_just_out_of_reach_is_driven_to(void)
{
    next_seeing_food(CLEAR, 155);
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 150));
}

static void test_food_is_eaten_only_after_a_step(void)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 100));
}

static void test_food_is_eaten_even_where_the_step_met_an_obstacle(void)
{
    next_seeing_food(CLEAR, 155);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(FRONT, 149).reason);
}

static void test_after_eating_it_goes_on(void)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_clear_way_is_driven_one_step);
    RUN_TEST(test_a_step_with_food_in_sight_is_toward_it);
    RUN_TEST(test_without_food_in_sight_it_looks_around);
    RUN_TEST(test_it_looks_around_even_where_the_step_met_an_obstacle);
    RUN_TEST(test_food_within_reach_is_eaten);
    RUN_TEST(test_food_just_out_of_reach_is_driven_to);
    RUN_TEST(test_food_is_eaten_only_after_a_step);
    RUN_TEST(test_food_is_eaten_even_where_the_step_met_an_obstacle);
    RUN_TEST(test_after_eating_it_goes_on);
    return UNITY_END();
}
