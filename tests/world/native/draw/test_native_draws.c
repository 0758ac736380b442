#include <string.h>

#include "host_sim/world/native/draw/draws.h"
#include "tests/test.h"

/* What Python 3.11 gives. */
static struct draws draws;

TEST(the_first_numbers_are_those_of_python)
{
    draws_seed(&draws, "octet 1 1");
    TEST_ASSERT_EQUAL_DOUBLE(0x1.7d4265f35ff80p-4, draws_next(&draws));
    TEST_ASSERT_EQUAL_DOUBLE(0x1.222ee7a532ec6p-2, draws_next(&draws));
}

TEST(later_numbers_are_those_of_python_too)
{
    static const struct {
        unsigned at;
        double number;
    } later[] = {{311, 0x1.980cbaca01ff0p-4}, {312, 0x1.76f7f3a0f1094p-3}, {999, 0x1.04777fbe89209p-1}};
    double number = 0.0;
    unsigned at = 0;

    draws_seed(&draws, "octet 1 1");
    for (unsigned i = 0; i < sizeof later / sizeof *later; i++) {
        for (; at <= later[i].at; at++)
            number = draws_next(&draws);
        TEST_ASSERT_EQUAL_DOUBLE(later[i].number, number);
    }
}

TEST(a_text_may_be_empty)
{
    draws_seed(&draws, "");
    TEST_ASSERT_EQUAL_DOUBLE(0x1.eba2b25d163e4p-1, draws_next(&draws));
}

TEST(what_is_beyond_the_longest_text_is_ignored)
{
    char text[DRAWS_TEXT_MAX + 2] = "";

    memset(text, 'x', DRAWS_TEXT_MAX + 1);
    draws_seed(&draws, text);
    TEST_ASSERT_EQUAL_DOUBLE(0x1.4a33c26cab4ebp-1, draws_next(&draws));
}

TEST(a_number_between_others_is_one_draw)
{
    draws_seed(&draws, "octet 1 1");
    TEST_ASSERT_EQUAL_DOUBLE(2.4654045021288677, draws_between(&draws, 2.0, 7.0));
    TEST_ASSERT_EQUAL_DOUBLE(0x1.222ee7a532ec6p-2, draws_next(&draws));
}

static void hash_of(const uint8_t *bytes, size_t count, uint8_t out[SHA512_BYTES])
{
    struct sha512 hash;

    sha512_begin(&hash);
    for (size_t at = 0; at < count; at += 7)
        sha512_add(&hash, &bytes[at], count - at < 7 ? count - at : 7);
    sha512_end(&hash, out);
}

/* What each length's text gives is hashed once more: Python's hashlib has the same hash of all of it. */
TEST(texts_of_all_lengths_around_two_blocks_have_their_hashes)
{
    static const uint8_t of_all[SHA512_BYTES] = {
        0xAC, 0x2E, 0xFB, 0x9C, 0x9A, 0xDB, 0xBD, 0x0A, 0x5C, 0x0E, 0x78, 0xEB, 0x0A, 0xB2, 0xF3, 0x82,
        0x2F, 0xA4, 0x2B, 0x9D, 0xAE, 0xF6, 0x85, 0x24, 0x9C, 0xB3, 0x1E, 0x94, 0x0D, 0xEF, 0x2D, 0xE2,
        0xF2, 0xBB, 0x88, 0x61, 0x68, 0x88, 0x41, 0xB7, 0xFD, 0x16, 0x48, 0xBE, 0x65, 0x88, 0xBA, 0xD1,
        0xB5, 0xBB, 0xFF, 0x71, 0xEC, 0x1F, 0x08, 0x62, 0xA5, 0x00, 0xC3, 0x94, 0x12, 0x1C, 0xE2, 0x3D,
    };
    uint8_t bytes[300], out[SHA512_BYTES];
    struct sha512 all;

    for (unsigned i = 0; i < sizeof bytes; i++)
        bytes[i] = (uint8_t)(i * 3);
    sha512_begin(&all);
    for (unsigned count = 0; count <= sizeof bytes; count++) {
        hash_of(bytes, count, out);
        sha512_add(&all, out, SHA512_BYTES);
    }
    sha512_end(&all, out);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(of_all, out, SHA512_BYTES);
}

TEST(abc_has_the_hash_of_the_standard_to_the_last_byte)
{
    static const uint8_t expected[SHA512_BYTES] = {
        0xDD, 0xAF, 0x35, 0xA1, 0x93, 0x61, 0x7A, 0xBA, 0xCC, 0x41, 0x73, 0x49, 0xAE, 0x20, 0x41, 0x31,
        0x12, 0xE6, 0xFA, 0x4E, 0x89, 0xA9, 0x7E, 0xA2, 0x0A, 0x9E, 0xEE, 0xE6, 0x4B, 0x55, 0xD3, 0x9A,
        0x21, 0x92, 0x99, 0x2A, 0x27, 0x4F, 0xC1, 0xA8, 0x36, 0xBA, 0x3C, 0x23, 0xA3, 0xFE, 0xEB, 0xBD,
        0x45, 0x4D, 0x44, 0x23, 0x64, 0x3C, 0xE8, 0x0E, 0x2A, 0x9A, 0xC9, 0x4F, 0xA5, 0x4C, 0xA4, 0x9F,
    };
    uint8_t out[SHA512_BYTES];

    sha512((const uint8_t *)"abc", 3, out);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, out, SHA512_BYTES);
}
