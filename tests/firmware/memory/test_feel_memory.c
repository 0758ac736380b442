#include "firmware/memory/memory.h"
#include "tests/test.h"

enum { FIRST_BLOCKED = FEEL_FRONT_RIGHT, ALL = 31 };

static struct memory memory;

void setUp(void)
{
    memory_erase(&memory);
}

static bool is_blocked(uint8_t feel)
{
    return (feel & (FEEL_FRONT_RIGHT | FEEL_FRONT | FEEL_FRONT_LEFT)) != 0;
}

TEST(each_reading_has_two_bits_of_its_own)
{
    for (uint8_t feel = 0; feel <= ALL; feel++)
        if (is_blocked(feel))
            feel_memory_learn(&memory, feel, feel % 3);
    for (uint8_t feel = 0; feel <= ALL; feel++)
        if (is_blocked(feel))
            TEST_ASSERT_EQUAL(feel % 3, feel_memory_recall(&memory, feel));
}

TEST(reading_n_is_at_bit_2n)
{
    static const uint8_t expected[CELL_COUNT] = {0x2F, 0, 0, 0, 0, 0, 0, 0x40};

    feel_memory_learn(&memory, 2, SIDE_RIGHT);
    feel_memory_learn(&memory, ALL, SIDE_LEFT);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, memory.cell, CELL_COUNT);
}

TEST(a_lesson_replaces_an_older_one)
{
    feel_memory_learn(&memory, ALL, SIDE_RIGHT);
    feel_memory_learn(&memory, ALL, SIDE_LEFT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, feel_memory_recall(&memory, ALL));
}

TEST(what_was_learned_is_such_a_memory)
{
    for (uint8_t feel = FIRST_BLOCKED; feel <= ALL; feel++)
        if (is_blocked(feel)) {
            feel_memory_learn(&memory, feel, SIDE_RIGHT);
            TEST_ASSERT_TRUE(feel_memory_is(memory.cell));
        }
}

TEST(an_empty_memory_is_such_a_memory)
{
    TEST_ASSERT_TRUE(feel_memory_is(memory.cell));
}

TEST(bytes_without_the_mark_are_not_such_a_memory)
{
    feel_memory_learn(&memory, ALL, SIDE_RIGHT);
    for (unsigned bit = 0; bit < 4; bit++) {
        struct memory unmarked = memory;

        unmarked.cell[0] &= (uint8_t)~(1u << bit);
        TEST_ASSERT_FALSE(feel_memory_is(unmarked.cell));
    }
}

TEST(bytes_with_a_turn_for_a_clear_way_are_not_such_a_memory)
{
    feel_memory_learn(&memory, FEEL_LEFT, SIDE_RIGHT);
    TEST_ASSERT_FALSE(feel_memory_is(memory.cell));
}

TEST(bytes_with_an_unknown_side_are_not_such_a_memory)
{
    feel_memory_learn(&memory, ALL, SIDE_RIGHT);
    memory.cell[CELL_COUNT - 1] = 0xC0;
    TEST_ASSERT_FALSE(feel_memory_is(memory.cell));
}

TEST(with_any_side_for_a_clear_way_it_is_none)
{
    for (unsigned side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        struct memory marked = {{0x0F}};

        feel_memory_learn(&marked, FEEL_LEFT, (enum side)side);
        TEST_ASSERT_FALSE(feel_memory_is(marked.cell));
    }
}
