#include "host_sim/world/native/draw/draws.h"
#include "tests/test.h"

#include <string.h>

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
