#include "host_sim/world/native/draw/written_fault.h"
#include "tests/test.h"

#include <string.h>

static struct written_fault fault;

TEST(words_follow_the_name_of_the_entry)
{
    TEST_ASSERT_FALSE(written_fails(&fault, WRITTEN_BARS, 2, " is %s, not %g", "7", 8.5));
    TEST_ASSERT_EQUAL_INT32(WRITTEN_BARS, fault.key);
    TEST_ASSERT_EQUAL_INT32(2, fault.entry);
    TEST_ASSERT_EQUAL_STRING("bar %g is 7, not %g", fault.text);
    TEST_ASSERT_EQUAL_UINT32(2, fault.value_count);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, fault.values[0]);
    TEST_ASSERT_EQUAL_DOUBLE(8.5, fault.values[1]);
}

TEST(words_that_begin_with_a_letter_stand_alone)
{
    (void)written_fails(&fault, WRITTEN_FOOD, -1, "it is so");
    TEST_ASSERT_EQUAL_STRING("it is so", fault.text);
    (void)written_fails(&fault, WRITTEN_FOOD, -1, ": so");
    TEST_ASSERT_EQUAL_STRING("food: so", fault.text);
    TEST_ASSERT_EQUAL_UINT32(0, fault.value_count);
}

TEST(what_is_too_long_is_cut)
{
    char text[2 * WRITTEN_TEXT_MAX] = "";

    memset(text, 'x', sizeof text - 1);
    (void)written_fails(&fault, WRITTEN_SIZE, -1, "a%s%s", text, text);
    TEST_ASSERT_EQUAL_size_t(WRITTEN_TEXT_MAX - 1, strlen(fault.text));
}

TEST(values_beyond_the_array_are_dropped)
{
    (void)written_fails(&fault, WRITTEN_SIZE, -1, "a%g%g%g%g%g%g%g%g%g", 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
    TEST_ASSERT_EQUAL_UINT32(WRITTEN_VALUES_MAX, fault.value_count);
    TEST_ASSERT_EQUAL_DOUBLE(8.0, fault.values[WRITTEN_VALUES_MAX - 1]);
}
