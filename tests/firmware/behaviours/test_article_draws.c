/* What it leaves to chance: every draw is the article's, and no action draws more. */
#include "brain_rig.h"

enum { MANY = 2000 };

void setUp(void)
{
    begin(PROFILE_ARTICLE);
}

TEST(looking_around_is_by_2_to_11_degrees_either_way)
{
    bool seen[23] = {false};   /* -11..11 degrees */

    for (unsigned i = 0; i < MANY; i++) {
        struct action look_around;

        next(CLEAR);
        look_around = next(CLEAR);
        TEST_ASSERT_INT_WITHIN(11, 0, look_around.turn_deg);
        seen[look_around.turn_deg + 11] = true;
    }
    for (int turn_deg = -11; turn_deg <= 11; turn_deg++)
        TEST_ASSERT_EQUAL(turn_deg < -1 || turn_deg > 1, seen[turn_deg + 11]);
}

TEST(either_way_of_looking_around_is_as_likely)
{
    unsigned right = 0;

    for (unsigned i = 0; i < MANY; i++) {
        next(CLEAR);
        right += next(CLEAR).turn_deg > 0;
    }
    TEST_ASSERT_UINT_WITHIN(112, MANY / 2, right);   /* five standard deviations */
}

TEST(either_way_of_trying_is_as_likely)
{
    unsigned right = 0;

    for (unsigned i = 0; i < MANY; i++)
        right += next(FRONT).turn_deg > 0;
    TEST_ASSERT_UINT_WITHIN(112, MANY / 2, right);
}

TEST(turning_about_is_by_150_to_209_degrees_to_the_right)
{
    bool seen[60] = {false};

    learned(PATTERN_FRONT, SIDE_LEFT);
    for (unsigned i = 0; i < MANY; i++) {
        int turn_deg;

        next(CLEAR);
        next(CLEAR);
        remembered_turns(10);
        turn_deg = next(FRONT).turn_deg;
        TEST_ASSERT_TRUE(turn_deg >= 150 && turn_deg <= 209);
        seen[turn_deg - 150] = true;
    }
    for (unsigned i = 0; i < 60; i++)
        TEST_ASSERT_TRUE(seen[i]);
}

TEST(equal_seeds_make_equal_choices)
{
    for (unsigned i = 0; i < 100; i++) {
        int first;

        brain_start(&brain, PROFILE_ARTICLE, i);
        first = next(FRONT).turn_deg;
        brain_start(&brain, PROFILE_ARTICLE, i);
        TEST_ASSERT_EQUAL(first, next(FRONT).turn_deg);
    }
}

TEST(a_step_a_meal_and_a_remembered_turn_draw_no_random_number)
{
    struct random before;

    learned(PATTERN_FRONT, SIDE_LEFT);
    before = brain.random;
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    remembered_turns(10);
    TEST_ASSERT_EQUAL_MEMORY(&before, &brain.random, sizeof before);
}

/* The article's draws: random(2) is 1 for a look to the right. */
TEST(it_looks_to_the_right_where_the_draw_is_1)
{
    for (unsigned i = 0; i < 20; i++) {
        struct random dice;

        next(CLEAR);
        dice = brain.random;
        TEST_ASSERT_EQUAL(random_below(&dice, 2) == 1, next(CLEAR).turn_deg > 0);
    }
}

/* random(2) + 1 is the side: 1 left, 2 right. */
TEST(it_tries_the_side_that_is_drawn)
{
    for (unsigned i = 0; i < 20; i++) {
        struct random dice = brain.random;

        TEST_ASSERT_EQUAL(random_below(&dice, 2) + 1 == SIDE_RIGHT, next(FRONT).turn_deg > 0);
    }
}
