/* The random draws: each is that of the article, and no action makes more. */
#include "brain_rig.h"

enum { MANY = 2000 };

BEFORE_EACH(article_draws)
{
    begin(PROFILE_ARTICLE);
}

TEST(look_around_turns_2_to_11_degrees_either_way)
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

TEST(look_around_sides_are_equally_likely)
{
    unsigned right = 0;

    for (unsigned i = 0; i < MANY; i++) {
        next(CLEAR);
        right += next(CLEAR).turn_deg > 0;
    }
    TEST_ASSERT_UINT_WITHIN(112, MANY / 2, right);   /* five standard deviations */
}

TEST(trial_sides_are_equally_likely)
{
    unsigned right = 0;

    for (unsigned i = 0; i < MANY; i++)
        right += next(FRONT).turn_deg > 0;
    TEST_ASSERT_UINT_WITHIN(112, MANY / 2, right);
}

TEST(boredom_turns_150_to_209_degrees_to_the_right)
{
    bool seen[60] = {false};

    teach(PATTERN_FRONT, SIDE_LEFT);
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

TEST(step_meal_and_remembered_turn_draw_no_random_number)
{
    struct random before;

    teach(PATTERN_FRONT, SIDE_LEFT);
    before = brain.random;
    next_seeing_food(CLEAR, 155);
    next_seeing_food(CLEAR, 149);
    remembered_turns(10);
    TEST_ASSERT_EQUAL_MEMORY(&before, &brain.random, sizeof before);
}

/* The article's draws: random(2) is 1 for a look to the right. */
TEST(look_around_is_to_the_right_when_the_draw_is_1)
{
    for (unsigned i = 0; i < 20; i++) {
        struct random dice;

        next(CLEAR);
        dice = brain.random;
        TEST_ASSERT_EQUAL(random_below(&dice, 2) == 1, next(CLEAR).turn_deg > 0);
    }
}

/* random(2) + 1 is the side: 1 left, 2 right. */
TEST(trial_turns_to_the_drawn_side)
{
    for (unsigned i = 0; i < 20; i++) {
        struct random dice = brain.random;

        TEST_ASSERT_EQUAL(random_below(&dice, 2) + 1 == SIDE_RIGHT, next(FRONT).turn_deg > 0);
    }
}

/* The count of remembered turns, and boredom. */

BEFORE_EACH(article_boredom)
{
    begin(PROFILE_ARTICLE);
    teach(PATTERN_FRONT, SIDE_LEFT);
}

TEST(nine_remembered_turns_cause_no_boredom)
{
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
}

TEST(tenth_remembered_turn_causes_boredom)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

/* The count is reset only where the way is clear: the eleventh turn is not the first of a new ten. */
TEST(boredom_occurs_once_until_the_way_is_clear)
{
    remembered_turns(10);
    next(FRONT);
    remembered_turns(MANY);
}

TEST(boredom_turn_is_made_when_the_way_is_clear)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(CLEAR).reason);
}

TEST(clear_way_resets_the_repeat_count)
{
    remembered_turns(9);
    next(CLEAR);
    next(FRONT);   /* looks around */
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

TEST(trial_keeps_the_repeat_count)
{
    remembered_turns(9);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT_RIGHT).reason);
    remembered_turns(1);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

TEST(repeat_count_saturates_at_255)
{
    remembered_turns(10);
    next(FRONT);
    remembered_turns(300);
    TEST_ASSERT_EQUAL_UINT8(255, brain.repeat_count);
}

TEST(boredom_occurs_once_at_the_greatest_limit)
{
    config.value[BOREDOM_LIMIT] = 254;
    remembered_turns(254);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
    remembered_turns(MANY);
}

TEST(start_resets_the_repeat_count)
{
    remembered_turns(9);
    brain_start(&brain, PROFILE_ARTICLE, 2);
    TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
}
