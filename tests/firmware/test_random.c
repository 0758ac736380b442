#include "firmware/random.h"

#include <stdbool.h>
#include <stdio.h>

#include "tests/test.h"

static struct random dice;

void setUp(void)
{
    random_seed(&dice, 1);
}

/* From the authors' own C code for the state 1, 2; a Python version gave the same. */
TEST(sequence_is_that_of_xoroshiro64_star_star)
{
    static const uint32_t published[10] = {3802928447u, 813792938u,  1618621494u, 2955957307u, 3252880261u,
                                           1129983909u, 2539651700u, 1327610908u, 1757650787u, 2763843748u};

    dice = (struct random){{1, 2}};
    for (unsigned i = 0; i < 10; i++)
        TEST_ASSERT_EQUAL_UINT32(published[i], random_next(&dice));
}

/* From another implementation, in JavaScript: the seed goes twice through splitmix32 as bryc publishes it, which is the state of
 * xoroshiro64** as its authors do; a draw takes the highest bits until they are below n. */
static const struct {
    uint32_t seed, state[2], next[4];
    uint8_t draws[12];   /* below 2, 3, 10, 60, 129, 200, 255, 1, 2, 3, 10, 60 */
} ANSWERS[] = {
    {0, {0x64625032, 0xD9C0799C}, {0x89E2144C, 0xF487E881, 0x67A247E0, 0x2D35B771}, {1, 0, 7, 45, 116, 180, 74, 0, 0, 2, 9, 11}},
    {1, {0x5E2D1772, 0x14E498F0}, {0x51E16C10, 0xFD494FAC, 0x12079E58, 0x1427CC18}, {1, 1, 2, 20, 12, 158, 107, 0, 1, 2, 1, 12}},
    {2, {0x0860B879, 0xAAC14680}, {0xA656DDF4, 0x4516356E, 0x3DE2F580, 0x24DDB744}, {0, 1, 4, 22, 27, 124, 9, 0, 0, 1, 0, 33}},
    {42, {0x20E44818, 0x0895A923}, {0x3D80F523, 0x7AA37413, 0xEB48EF7E, 0x96612DCD}, {1, 2, 6, 34, 111, 43, 101, 0, 0, 1, 8, 9}},
    {0x80000000, {0x859DC57D, 0xEB16DB32}, {0x477691D8, 0x19837701, 0x1B44A3BD, 0x9DFBB372},
     {1, 1, 9, 46, 88, 86, 148, 0, 0, 0, 2, 47}},
    {0xFFFFFFFF, {0xEB721C8A, 0xFFE8BD34}, {0xEECBC0E3, 0xF457028A, 0x4BF68741, 0xDB3AEF8F},
     {0, 0, 4, 22, 22, 63, 108, 0, 1, 1, 3, 31}},
};

enum { ANSWER_COUNT = sizeof ANSWERS / sizeof ANSWERS[0] };

TEST(seed_gives_the_reference_state_and_sequence)
{
    for (unsigned i = 0; i < ANSWER_COUNT; i++) {
        random_seed(&dice, ANSWERS[i].seed);
        TEST_ASSERT_EQUAL_HEX32_ARRAY(ANSWERS[i].state, dice.state, 2);
        for (unsigned n = 0; n < 4; n++)
            TEST_ASSERT_EQUAL_HEX32(ANSWERS[i].next[n], random_next(&dice));
    }
}

TEST(draws_match_the_reference)
{
    static const uint8_t below[12] = {2, 3, 10, 60, 129, 200, 255, 1, 2, 3, 10, 60};

    for (unsigned i = 0; i < ANSWER_COUNT; i++) {
        random_seed(&dice, ANSWERS[i].seed);
        for (unsigned n = 0; n < 12; n++)
            TEST_ASSERT_EQUAL_UINT8(ANSWERS[i].draws[n], random_below(&dice, below[n]));
    }
}

TEST(neighbouring_seeds_give_different_sequences)
{
    for (uint32_t seed = 0; seed < 1000; seed++) {
        struct random one, next;

        random_seed(&one, seed);
        random_seed(&next, seed + 1);
        TEST_ASSERT_NOT_EQUAL_UINT32(random_next(&one), random_next(&next));
    }
}

/* The first choice that a robot makes: seeds 0, 1, 2.. must not all make the same. */
TEST(first_draw_of_neighbouring_seeds_is_fair)
{
    unsigned ones = 0;

    for (uint32_t seed = 0; seed < 10000; seed++) {
        random_seed(&dice, seed);
        ones += random_below(&dice, 2);
    }
    TEST_ASSERT_UINT_WITHIN(250, 5000, ones);   /* five standard deviations */
}

/* These two seeds make one word of the state 0. */
TEST(no_seed_gives_an_all_zero_state)
{
    static const uint32_t seeds[2] = {0u - 0x9e3779b9u, 0u - 0x3c6ef372u};

    for (unsigned i = 0; i < 2; i++) {
        random_seed(&dice, seeds[i]);
        TEST_ASSERT_TRUE(dice.state[0] != 0 || dice.state[1] != 0);
    }
}

TEST(random_below_reaches_exactly_0_to_n_minus_1)
{
    for (unsigned n = 1; n <= UINT8_MAX; n++) {
        bool seen[UINT8_MAX + 1] = {false};

        for (unsigned i = 0; i < 20 * n; i++)
            seen[random_below(&dice, (uint8_t)n)] = true;
        for (unsigned value = 0; value <= UINT8_MAX; value++)
            TEST_ASSERT_EQUAL(value < n, seen[value]);
    }
}

static void assert_fair(uint8_t n)
{
    enum { EACH = 10000, FIVE_DEVIATIONS = 500 };
    unsigned counts[UINT8_MAX] = {0};
    char text[] = "below ...";

    (void)snprintf(text, sizeof text, "below %u", n);
    for (unsigned i = 0; i < n * (unsigned)EACH; i++)
        counts[random_below(&dice, n)]++;
    for (unsigned value = 0; value < n; value++)
        TEST_ASSERT_UINT_WITHIN_MESSAGE(FIVE_DEVIATIONS, EACH, counts[value], text);
}

/* 256 % 60 is 16: a plain remainder would draw 0..15 a quarter too often. Below 129, half of the draws are rejected. */
TEST(random_below_is_uniform)
{
    static const uint8_t choices[] = {2, 10, 60, 129, 255};

    for (unsigned i = 0; i < sizeof choices; i++)
        assert_fair(choices[i]);
}
