#include "tests/test.h"
#include "firmware/memory/memory.h"

static const struct memory LEARNED = {{0, 1, 2, 1, 2, 1, 2, 2}};

static struct memory memory;

BEFORE_EACH(memory)
{
    memory = LEARNED;
}

TEST(memory_is_eight_bytes)
{
    TEST_ASSERT_EQUAL_size_t(8, sizeof(struct memory));
}

TEST(erased_memory_recalls_no_side)
{
    memory_erase(&memory);
    for (uint8_t p = 0; p < CELL_COUNT; p++)
        TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&memory, p));
}

TEST(cell_recalls_its_own_side)
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

TEST(lesson_replaces_an_older_lesson)
{
    memory_learn(&memory, 1, SIDE_RIGHT);
    TEST_ASSERT_EQUAL(SIDE_RIGHT, memory_recall(&memory, 1));
}

TEST(cell_is_empty_or_a_side_with_confidence_1_to_3)
{
    static const bool valid[] = {[0] = true, [5] = true, [6] = true, [9] = true, [10] = true, [13] = true, [14] = true};

    for (unsigned cell = 0; cell <= UINT8_MAX; cell++)
        TEST_ASSERT_EQUAL(cell < sizeof valid && valid[cell], confidence_is_cell((uint8_t)cell));
}

TEST(cell_holds_side_in_low_bits_and_confidence_above)
{
    TEST_ASSERT_EQUAL_UINT8(5, confidence_cell(SIDE_LEFT, 1));
    TEST_ASSERT_EQUAL_UINT8(14, confidence_cell(SIDE_RIGHT, 3));
}

TEST(confidence_changed_saturates_at_3)
{
    TEST_ASSERT_EQUAL_UINT8(9, confidence_changed(5, 1));
    TEST_ASSERT_EQUAL_UINT8(14, confidence_changed(14, 1));
}

TEST(cell_without_confidence_becomes_empty)
{
    TEST_ASSERT_EQUAL_UINT8(6, confidence_changed(14, -2));
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(10, -2));
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(5, -2));
}

TEST(confidence_changed_keeps_an_empty_cell)
{
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(0, 1));
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(0, -2));
}

enum { UPPER = 1 << 4 };   /* of a write: it is to cells 4..7 */

static void assert_unchanged(void)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(LEARNED.cell, memory.cell, CELL_COUNT);
}

TEST(memory_of_every_kind_is_adopted)
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

TEST(bytes_of_no_memory_kind_are_rejected)
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
    assert_unchanged();
}

TEST(adoption_rejects_a_side_for_a_clear_way)
{
    static const uint8_t cells[CELL_COUNT] = {SIDE_LEFT};

    TEST_ASSERT_FALSE(memory_adopt(&memory, cells));
    assert_unchanged();
}

TEST(write_sets_four_cells_of_a_half)
{
    static const uint8_t expected[CELL_COUNT] = {0, 2, 1, 0, 1, 2, 0, 1};

    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, 0xF, 0x00010200));
    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, UPPER | 0xF, 0x01000201));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, memory.cell, CELL_COUNT);
}

TEST(write_keeps_cells_outside_the_mask)
{
    static const uint8_t expected[CELL_COUNT] = {0, 1, 2, 0, 2, 1, 2, 1};

    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, 1u << 3, 0x00FFFFFF));
    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, UPPER | 1u << 3, 0x01FFFFFF));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, memory.cell, CELL_COUNT);
}

TEST(write_ignores_values_outside_the_mask)
{
    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_SIDES, UPPER | 0, 0xFFFFFFFF));
    assert_unchanged();
}

TEST(write_of_an_invalid_side_changes_no_cell)
{
    /* Cell 7 is no side; cells 4..6 would be emptied. */
    TEST_ASSERT_FALSE(memory_write(&memory, MEMORY_KIND_SIDES, UPPER | 0xF, 3u << 24));
    assert_unchanged();
}

TEST(write_of_a_side_for_a_clear_way_changes_no_cell)
{
    TEST_ASSERT_FALSE(memory_write(&memory, MEMORY_KIND_SIDES, 0xF, SIDE_LEFT));
    assert_unchanged();
}

TEST(write_is_checked_against_the_memory_kind)
{
    TEST_ASSERT_FALSE(memory_write(&memory, MEMORY_KIND_SIDES, 1u << 1, 5u << 8));
    assert_unchanged();
    memory_erase(&memory);
    TEST_ASSERT_FALSE(memory_write(&memory, MEMORY_KIND_CONFIDENCE, 1u << 1, 1u << 8));
    TEST_ASSERT_TRUE(memory_write(&memory, MEMORY_KIND_CONFIDENCE, 1u << 1, 5u << 8));
    TEST_ASSERT_EQUAL(SIDE_LEFT, memory_recall(&memory, 1));
}

static const uint8_t SIDES[CELL_COUNT] = {0, 1, 2, 1, 0, 0, 2, 1};
static const uint8_t LEAST_SURE[CELL_COUNT] = {0, 5, 6, 5, 0, 0, 6, 5};

BEFORE_EACH(memory_kind)
{
    TEST_ASSERT_TRUE(memory_adopt(&memory, SIDES));
}

static void assert_translated(enum memory_kind kind, const uint8_t expected[CELL_COUNT])
{
    TEST_ASSERT_TRUE(memory_translate(&memory, kind));
    TEST_ASSERT_TRUE(memory_is(memory.cell, kind));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, memory.cell, CELL_COUNT);
}

TEST(only_an_empty_memory_is_of_several_kinds)
{
    TEST_ASSERT_FALSE(memory_is(SIDES, MEMORY_KIND_CONFIDENCE));
    TEST_ASSERT_FALSE(memory_is(SIDES, MEMORY_KIND_ALL_SENSORS));
    TEST_ASSERT_FALSE(memory_is(LEAST_SURE, MEMORY_KIND_SIDES));
    TEST_ASSERT_FALSE(memory_is(LEAST_SURE, MEMORY_KIND_ALL_SENSORS));
    memory_erase(&memory);
    for (unsigned kind = 0; kind < MEMORY_KIND_COUNT; kind++)
        TEST_ASSERT_TRUE(memory_is(memory.cell, (enum memory_kind)kind));
}

TEST(translation_to_the_same_kind_changes_no_cell)
{
    TEST_ASSERT_FALSE(memory_translate(&memory, MEMORY_KIND_SIDES));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(SIDES, memory.cell, CELL_COUNT);
}

TEST(translation_gives_sides_the_least_confidence)
{
    assert_translated(MEMORY_KIND_CONFIDENCE, LEAST_SURE);
}

TEST(translation_to_sides_drops_confidence)
{
    static const uint8_t sure[CELL_COUNT] = {0, 13, 10, 9, 0, 0, 6, 13};

    TEST_ASSERT_TRUE(memory_adopt(&memory, sure));
    assert_translated(MEMORY_KIND_SIDES, SIDES);
}

TEST(translation_fills_readings_of_all_side_sensors)
{
    TEST_ASSERT_TRUE(memory_translate(&memory, MEMORY_KIND_ALL_SENSORS));
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++)
        for (unsigned beside = 0; beside < 4; beside++) {
            unsigned feel = (unsigned)pattern << 1 | (beside & 1u) * FEEL_RIGHT | (beside >> 1) * FEEL_LEFT;

            TEST_ASSERT_EQUAL(SIDES[pattern], feel_memory_recall(&memory, (uint8_t)feel));
        }
}

TEST(translation_to_all_sensors_and_back_is_lossless)
{
    TEST_ASSERT_TRUE(memory_translate(&memory, MEMORY_KIND_ALL_SENSORS));
    assert_translated(MEMORY_KIND_SIDES, SIDES);
    assert_translated(MEMORY_KIND_CONFIDENCE, LEAST_SURE);
    TEST_ASSERT_TRUE(memory_translate(&memory, MEMORY_KIND_ALL_SENSORS));
    assert_translated(MEMORY_KIND_CONFIDENCE, LEAST_SURE);
}

TEST(translation_takes_the_majority_of_readings)
{
    static const uint8_t expected[CELL_COUNT] = {0, 0, 2, 0, 1};

    memory_erase(&memory);
    feel_memory_learn(&memory, FEEL_FRONT, SIDE_LEFT);
    feel_memory_learn(&memory, FEEL_FRONT | FEEL_LEFT, SIDE_RIGHT);
    feel_memory_learn(&memory, FEEL_FRONT | FEEL_RIGHT, SIDE_RIGHT);
    feel_memory_learn(&memory, FEEL_FRONT_RIGHT, SIDE_LEFT);
    feel_memory_learn(&memory, FEEL_FRONT_RIGHT | FEEL_RIGHT, SIDE_RIGHT);
    feel_memory_learn(&memory, FEEL_FRONT_LEFT | FEEL_LEFT, SIDE_LEFT);
    assert_translated(MEMORY_KIND_SIDES, expected);
}

enum { FIRST_BLOCKED = FEEL_FRONT_RIGHT, ALL = 31 };

BEFORE_EACH(feel_memory)
{
    memory_erase(&memory);
}

static bool is_blocked(uint8_t feel)
{
    return (feel & (FEEL_FRONT_RIGHT | FEEL_FRONT | FEEL_FRONT_LEFT)) != 0;
}

TEST(feel_memory_stores_every_reading_separately)
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

TEST(feel_memory_lesson_replaces_an_older_lesson)
{
    feel_memory_learn(&memory, ALL, SIDE_RIGHT);
    feel_memory_learn(&memory, ALL, SIDE_LEFT);
    TEST_ASSERT_EQUAL(SIDE_LEFT, feel_memory_recall(&memory, ALL));
}

TEST(learned_readings_are_a_valid_feel_memory)
{
    for (uint8_t feel = FIRST_BLOCKED; feel <= ALL; feel++)
        if (is_blocked(feel)) {
            feel_memory_learn(&memory, feel, SIDE_RIGHT);
            TEST_ASSERT_TRUE(feel_memory_is(memory.cell));
        }
}

TEST(empty_memory_is_a_valid_feel_memory)
{
    TEST_ASSERT_TRUE(feel_memory_is(memory.cell));
}

TEST(bytes_without_the_mark_are_no_feel_memory)
{
    feel_memory_learn(&memory, ALL, SIDE_RIGHT);
    for (unsigned bit = 0; bit < 4; bit++) {
        struct memory unmarked = memory;

        unmarked.cell[0] &= (uint8_t)~(1u << bit);
        TEST_ASSERT_FALSE(feel_memory_is(unmarked.cell));
    }
}

TEST(side_for_a_clear_way_is_no_feel_memory)
{
    feel_memory_learn(&memory, FEEL_LEFT, SIDE_RIGHT);
    TEST_ASSERT_FALSE(feel_memory_is(memory.cell));
}

TEST(unknown_side_is_no_feel_memory)
{
    feel_memory_learn(&memory, ALL, SIDE_RIGHT);
    memory.cell[CELL_COUNT - 1] = 0xC0;
    TEST_ASSERT_FALSE(feel_memory_is(memory.cell));
}

TEST(marked_bytes_with_a_side_for_a_clear_way_are_no_feel_memory)
{
    for (unsigned side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        struct memory marked = {{0x0F}};

        feel_memory_learn(&marked, FEEL_LEFT, (enum side)side);
        TEST_ASSERT_FALSE(feel_memory_is(marked.cell));
    }
}
