#include "firmware/memory/memory.h"

#include "tests/test.h"

static const uint8_t SIDES[CELL_COUNT] = {0, 1, 2, 1, 0, 0, 2, 1};
static const uint8_t LEAST_SURE[CELL_COUNT] = {0, 5, 6, 5, 0, 0, 6, 5};

static struct memory memory;

void setUp(void)
{
    TEST_ASSERT_TRUE(memory_adopt(&memory, SIDES));
}

static void assert_translated(enum memory_kind kind, const uint8_t expected[CELL_COUNT])
{
    TEST_ASSERT_TRUE(memory_translate(&memory, kind));
    TEST_ASSERT_TRUE(memory_is(memory.cell, kind));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, memory.cell, CELL_COUNT);
}

TEST(no_memory_but_the_empty_one_is_of_two_kinds)
{
    TEST_ASSERT_FALSE(memory_is(SIDES, MEMORY_KIND_CONFIDENCE));
    TEST_ASSERT_FALSE(memory_is(SIDES, MEMORY_KIND_ALL_SENSORS));
    TEST_ASSERT_FALSE(memory_is(LEAST_SURE, MEMORY_KIND_SIDES));
    TEST_ASSERT_FALSE(memory_is(LEAST_SURE, MEMORY_KIND_ALL_SENSORS));
    memory_erase(&memory);
    for (unsigned kind = 0; kind < MEMORY_KIND_COUNT; kind++)
        TEST_ASSERT_TRUE(memory_is(memory.cell, (enum memory_kind)kind));
}

TEST(a_memory_of_its_own_kind_is_left_alone)
{
    TEST_ASSERT_FALSE(memory_translate(&memory, MEMORY_KIND_SIDES));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(SIDES, memory.cell, CELL_COUNT);
}

TEST(a_side_becomes_one_of_least_confidence)
{
    assert_translated(MEMORY_KIND_CONFIDENCE, LEAST_SURE);
}

TEST(confidence_is_dropped)
{
    static const uint8_t sure[CELL_COUNT] = {0, 13, 10, 9, 0, 0, 6, 13};

    TEST_ASSERT_TRUE(memory_adopt(&memory, sure));
    assert_translated(MEMORY_KIND_SIDES, SIDES);
}

TEST(a_side_holds_whatever_the_side_sensors_say)
{
    TEST_ASSERT_TRUE(memory_translate(&memory, MEMORY_KIND_ALL_SENSORS));
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++)
        for (unsigned beside = 0; beside < 4; beside++) {
            unsigned feel = (unsigned)pattern << 1 | (beside & 1u) * FEEL_RIGHT | (beside >> 1) * FEEL_LEFT;

            TEST_ASSERT_EQUAL(SIDES[pattern], feel_memory_recall(&memory, (uint8_t)feel));
        }
}

TEST(there_and_back_is_the_same)
{
    TEST_ASSERT_TRUE(memory_translate(&memory, MEMORY_KIND_ALL_SENSORS));
    assert_translated(MEMORY_KIND_SIDES, SIDES);
    assert_translated(MEMORY_KIND_CONFIDENCE, LEAST_SURE);
    TEST_ASSERT_TRUE(memory_translate(&memory, MEMORY_KIND_ALL_SENSORS));
    assert_translated(MEMORY_KIND_CONFIDENCE, LEAST_SURE);
}

TEST(of_several_readings_with_a_pattern_most_decide)
{
    static const uint8_t expected[CELL_COUNT] = {0, 0, 2};

    memory_erase(&memory);
    feel_memory_learn(&memory, FEEL_FRONT, SIDE_LEFT);
    feel_memory_learn(&memory, FEEL_FRONT | FEEL_LEFT, SIDE_RIGHT);
    feel_memory_learn(&memory, FEEL_FRONT | FEEL_RIGHT, SIDE_RIGHT);
    feel_memory_learn(&memory, FEEL_FRONT_RIGHT, SIDE_LEFT);
    feel_memory_learn(&memory, FEEL_FRONT_RIGHT | FEEL_RIGHT, SIDE_RIGHT);
    assert_translated(MEMORY_KIND_SIDES, expected);
}
