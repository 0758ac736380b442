/* Where the way is clear: steps, looks and meals. */
#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_ARTICLE);
}

TEST(a_clear_way_is_driven_one_step)
{
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}

TEST(a_step_with_food_in_sight_is_toward_it)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 500));
}

TEST(without_food_in_sight_it_looks_around)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(CLEAR).reason);
}

/* The listing does not read the sensors between the step and the look. */
TEST(it_looks_around_even_where_the_step_met_an_obstacle)
{
    next(CLEAR);
    TEST_ASSERT_EQUAL(REASON_LOOK_AROUND, next(FRONT).reason);
}

TEST(food_within_reach_is_eaten)
{
    next_seeing_food(CLEAR, 155);
    assert_action(REASON_EAT, 0, 0, next_seeing_food(CLEAR, 149));
}

TEST(food_just_out_of_reach_is_driven_to)
{
    next_seeing_food(CLEAR, 155);
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 150));
}

TEST(food_is_eaten_only_after_a_step)
{
    assert_action(REASON_TOWARD_FOOD, 0, 12, next_seeing_food(CLEAR, 100));
}

TEST(food_is_eaten_even_where_the_step_met_an_obstacle)
{
    next_seeing_food(CLEAR, 155);
    TEST_ASSERT_EQUAL(REASON_EAT, next_seeing_food(FRONT, 149).reason);
}

TEST(after_eating_it_goes_on)
{
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    assert_action(REASON_WANDER, 0, 12, next(CLEAR));
}
