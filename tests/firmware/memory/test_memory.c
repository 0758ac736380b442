#include "firmware/memory/memory.h"
#include "tests/test.h"

static const struct memory LEARNED = {{0, 1, 2, 1, 2, 1, 2, 2}};

static struct memory memory;

void setUp(void)
{
    memory = LEARNED;
}

TEST(the_memory_is_eight_bytes)
{
    TEST_ASSERT_EQUAL_size_t(8, sizeof(struct memory));
}

TEST(an_erased_memory_knows_nothing)
{
    memory_erase(&memory);
    for (uint8_t p = 0; p < CELL_COUNT; p++)
        TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&memory, p));
}

TEST(each_cell_recalls_its_own_side)
{
    for (uint8_t p = 0; p < CELL_COUNT; p++)
        TEST_ASSERT_EQUAL(LEARNED.cell[p], memory_recall(&memory, p));
}

TEST(learning_changes_one_cell_only)
{
    for (uint8_t p = 1; p < CELL_COUNT; p++) {
        uint8_t expected[CELL_COUNT] = {0};

        memory_erase(&memory);
        memory_learn(&memory, p, SIDE_RIGHT);
        expected[p] = SIDE_RIGHT;
        TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, memory.cell, CELL_COUNT);
    }
}

TEST(a_lesson_replaces_an_older_one)
{
    memory_learn(&memory, 1, SIDE_RIGHT);
    TEST_ASSERT_EQUAL(SIDE_RIGHT, memory_recall(&memory, 1));
}
