#include "firmware/memory.h"

#include <unity.h>

static const struct memory LEARNED = {{0, 1, 2, 1, 2, 1, 2, 2}};

static struct memory memory;

void setUp(void)
{
    memory = LEARNED;
}

void tearDown(void) {}

static void test_the_memory_is_eight_bytes(void)
{
    TEST_ASSERT_EQUAL_size_t(8, sizeof(struct memory));
}

static void test_an_erased_memory_knows_nothing(void)
{
    memory_erase(&memory);
    for (uint8_t p = 0; p < CELL_COUNT; p++)
        TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&memory, p));
}

static void test_each_cell_recalls_its_own_side(void)
{
    for (uint8_t p = 0; p < CELL_COUNT; p++)
        TEST_ASSERT_EQUAL(LEARNED.cell[p], memory_recall(&memory, p));
}

static void test_learning_changes_one_cell_only(void)
{
    for (uint8_t p = 1; p < CELL_COUNT; p++) {
        uint8_t expected[CELL_COUNT] = {0};

        memory_erase(&memory);
        memory_learn(&memory, p, SIDE_RIGHT);
        expected[p] = SIDE_RIGHT;
        TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, memory.cell, CELL_COUNT);
    }
}

static void test_a_lesson_replaces_an_older_one(void)
{
    memory_learn(&memory, 1, SIDE_RIGHT);
    TEST_ASSERT_EQUAL(SIDE_RIGHT, memory_recall(&memory, 1));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_memory_is_eight_bytes);
    RUN_TEST(test_an_erased_memory_knows_nothing);
    RUN_TEST(test_each_cell_recalls_its_own_side);
    RUN_TEST(test_learning_changes_one_cell_only);
    RUN_TEST(test_a_lesson_replaces_an_older_one);
    return UNITY_END();
}
