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

TEST(a_cell_is_nothing_or_a_side_with_confidence_1_to_3)
{
    static const bool valid[] = {[0] = true, [5] = true, [6] = true, [9] = true, [10] = true, [13] = true, [14] = true};

    for (unsigned cell = 0; cell <= UINT8_MAX; cell++)
        TEST_ASSERT_EQUAL(cell < sizeof valid && valid[cell], confidence_is_cell((uint8_t)cell));
}

TEST(the_side_is_below_and_the_confidence_above)
{
    TEST_ASSERT_EQUAL_UINT8(5, confidence_cell(SIDE_LEFT, 1));
    TEST_ASSERT_EQUAL_UINT8(14, confidence_cell(SIDE_RIGHT, 3));
}

TEST(more_confidence_ends_at_3)
{
    TEST_ASSERT_EQUAL_UINT8(9, confidence_changed(5, 1));
    TEST_ASSERT_EQUAL_UINT8(14, confidence_changed(14, 1));
}

TEST(a_cell_with_no_confidence_left_is_empty)
{
    TEST_ASSERT_EQUAL_UINT8(6, confidence_changed(14, -2));
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(10, -2));
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(5, -2));
}

TEST(an_empty_cell_stays_empty)
{
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(0, 1));
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(0, -2));
}

enum { UPPER = 1 << 4 };   /* of which */

static void assert_as_learned(void)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(LEARNED.cell, memory.cell, CELL_COUNT);
}

TEST(a_memory_of_each_kind_is_adopted)
{
    static const uint8_t of_each[MEMORY_KIND_COUNT][CELL_COUNT] = {
        [MEMORY_KIND_SIDES] = {0, 1, 2, 0, 0, 0, 0, 2},
        [MEMORY_KIND_CONFIDENCE] = {0, 5, 14, 0, 0, 0, 0, 6},
        [MEMORY_KIND_ALL_SENSORS] = {0x1F, 0, 0x99, 0, 0x20, 0, 0, 0x55},
    };

    for (unsigned kind = 0; kind < MEMORY_KIND_COUNT; kind++) {
        TEST_ASSERT_TRUE(memory_adopt(&memory, of_each[kind]));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(of_each[kind], memory.cell, CELL_COUNT);
    }
}

TEST(bytes_of_no_kind_are_not_adopted)
{
    static const uint8_t of_none[][CELL_COUNT] = {
        {0, 3},                          /* no side */
        {0, 4},                          /* confidence in nothing */
        {0, 1, 5},                       /* of two kinds */
        {0, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF},
        {0x1E, 0, 0, 0, 0, 0, 0, 0},     /* half a mark */
        {0x0F, 3, 0, 0, 0, 0, 0, 0},     /* marked, and no side */
    };

    for (unsigned i = 0; i < sizeof of_none / sizeof of_none[0]; i++)
        TEST_ASSERT_FALSE(memory_adopt(&memory, of_none[i]));
    assert_as_learned();
}

TEST(a_turn_for_a_clear_way_is_not_adopted)
{
    static const uint8_t cells[CELL_COUNT] = {SIDE_LEFT};

    TEST_ASSERT_FALSE(memory_adopt(&memory, cells));
    assert_as_learned();
}

TEST(writing_takes_a_byte_for_each_cell)
{
    static const uint8_t expected[CELL_COUNT] = {0, 2, 1, 0, 1, 2, 0, 1};

    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, 0xF, 0x00010200));
    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, UPPER | 0xF, 0x01000201));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, memory.cell, CELL_COUNT);
}

TEST(writing_leaves_the_cells_beside_the_mask)
{
    static const uint8_t expected[CELL_COUNT] = {0, 1, 2, 0, 2, 1, 2, 1};

    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, 1u << 3, 0x00FFFFFF));
    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, UPPER | 1u << 3, 0x01FFFFFF));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, memory.cell, CELL_COUNT);
}

TEST(writing_ignores_the_sides_beside_the_mask)
{
    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, UPPER | 0, 0xFFFFFFFF));
    assert_as_learned();
}

TEST(writing_what_is_no_side_changes_nothing)
{
    /* Cell 7 is no side; cells 4..6 would be emptied. */
    TEST_ASSERT_FALSE(memory_write(&memory, MEMORY_KIND_SIDES, UPPER | 0xF, 3u << 24));
    assert_as_learned();
}

TEST(writing_a_turn_for_a_clear_way_changes_nothing)
{
    TEST_ASSERT_FALSE(memory_write(&memory, MEMORY_KIND_SIDES, 0xF, SIDE_LEFT));
    assert_as_learned();
}

TEST(writing_is_judged_by_the_kind_in_use)
{
    TEST_ASSERT_FALSE(memory_write(&memory, MEMORY_KIND_SIDES, 1u << 1, 5u << 8));
    assert_as_learned();
    memory_erase(&memory);
    TEST_ASSERT_FALSE(memory_write(&memory, MEMORY_KIND_CONFIDENCE, 1u << 1, 1u << 8));
    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_CONFIDENCE, 1u << 1, 5u << 8));
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&memory, 1));
}
