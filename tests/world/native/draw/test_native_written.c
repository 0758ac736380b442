/* The faults of a written world: key, entry and text. */
#include "host_sim/world/native/draw/written.h"
#include "tests/test.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct layout_params PARAMS = {
    .width_mm = 4000.0, .height_mm = 3000.0, .body_radius_mm = 100.0, .sensor_reach_mm = 60.0, .bar_thickness_mm = 40.0,
};

static struct written written;
static struct written_fault fault;
static uint8_t cells[WRITTEN_CELLS_MAX];
static uint32_t stack[WRITTEN_CELLS_MAX];

void setUp(void)
{
    written_clear(&written);
    written_list(&written, WRITTEN_FOOD, 1);
    *written_entry(&written, WRITTEN_FOOD, 0) = (struct written_entry){2, {500.0, 500.0}};
}

static bool is_valid(void)
{
    struct reach reach = {.cells = cells, .stack = stack};

    return written_check(&written, PARAMS, &reach, &fault);
}

static void assert_fault(enum written_key key, int32_t entry, const char *words)
{
    char text[2 * WRITTEN_TEXT_MAX];
    const double *v = fault.values;

    TEST_ASSERT_FALSE(is_valid());
    TEST_ASSERT_EQUAL_INT32(key, fault.key);
    TEST_ASSERT_EQUAL_INT32(entry, fault.entry);
    for (unsigned i = fault.value_count; i < WRITTEN_VALUES_MAX; i++)
        TEST_ASSERT_EQUAL_DOUBLE(0.0, v[i]);
    (void)snprintf(text, sizeof text, fault.text, v[0], v[1], v[2], v[3], v[4], v[5]);
    TEST_ASSERT_EQUAL_STRING(words, text);
}

static void add_bar(double ax, double ay, double bx, double by)
{
    written.bars[written.bar_count++] = (struct written_entry){4, {ax, ay, bx, by}};
}

TEST(world_file_with_food_alone_is_valid)
{
    TEST_ASSERT_TRUE(is_valid());
    TEST_ASSERT_EQUAL_size_t(WRITTEN_CELLS_MAX, reach_size(WRITTEN_WIDTH_MAX_MM, WRITTEN_HEIGHT_MAX_MM));
}

TEST(world_without_food_is_refused)
{
    written_clear(&written);
    assert_fault(WRITTEN_FOOD, -1, "a world needs food, such as food = [[3500, 400]]");
}

TEST(size_out_of_range_is_refused)
{
    static const char words[] = "size must be [width, height] in mm, from [600, 600] to [6000, 5000]";

    written.size = (struct written_entry){2, {599.0, 2000.0}};
    assert_fault(WRITTEN_SIZE, -1, words);
    written.size.numbers[0] = 6001.0;
    assert_fault(WRITTEN_SIZE, -1, words);
    written.size = (struct written_entry){2, {2000.0, 5001.0}};
    assert_fault(WRITTEN_SIZE, -1, words);
    written.size = (struct written_entry){2, {6000.0, 5000.0}};
    TEST_ASSERT_TRUE(is_valid());
    written.size.count = 3;
    assert_fault(WRITTEN_SIZE, -1, "size must be [width, height]: 2 numbers");
}

TEST(missing_or_too_long_list_is_refused)
{
    written_list(&written, WRITTEN_BARS, WRITTEN_NO_LIST);
    assert_fault(WRITTEN_BARS, -1, "bars must be a list of at most 40 lists, such as [[...], [...]]");
    written_list(&written, WRITTEN_BARS, 0);
    written_list(&written, WRITTEN_FOOD, WRITTEN_FOOD_MAX + 1);
    assert_fault(WRITTEN_FOOD, -1, "food must be a list of at most 20 lists, such as [[...], [...]]");
}

TEST(written_world_has_a_place_for_each_entry)
{
    TEST_ASSERT_EQUAL_PTR(&written.size, written_entry(&written, WRITTEN_SIZE, 0));
    TEST_ASSERT_EQUAL_PTR(&written.start, written_entry(&written, WRITTEN_START, 0));
    TEST_ASSERT_EQUAL_PTR(&written.food[19], written_entry(&written, WRITTEN_FOOD, 19));
    TEST_ASSERT_NULL(written_entry(&written, WRITTEN_FOOD, 20));
    TEST_ASSERT_EQUAL_PTR(&written.bars[39], written_entry(&written, WRITTEN_BARS, 39));
    TEST_ASSERT_NULL(written_entry(&written, WRITTEN_BARS, 40));
}

TEST(entry_without_finite_numbers_is_refused)
{
    written.food[0].count = WRITTEN_NO_LIST;
    assert_fault(WRITTEN_FOOD, 0, "food 1 must be [x, y]: 2 numbers");
    written.food[0] = (struct written_entry){2, {500.0, (double)NAN}};
    assert_fault(WRITTEN_FOOD, 0, "food 1 must be [x, y]: 2 numbers");
    written.food[0].numbers[1] = 1e9;
    assert_fault(WRITTEN_FOOD, 0, "food 1 must be [x, y]: 2 numbers");
    add_bar(0.0, 0.0, 0.0, -(double)INFINITY);
    assert_fault(WRITTEN_BARS, 0, "bar 1 must be [x, y, x, y]: 4 numbers");
}

TEST(objects_outside_the_arena_are_refused)
{
    written.size = (struct written_entry){2, {2000.0, 1500.0}};
    add_bar(10.0, 10.0, 2000.5, 10.0);
    assert_fault(WRITTEN_BARS, 0, "bar 1: [2000.5, 10] is outside of the arena, whose size is [2000, 1500]");
    written.bars[0] = (struct written_entry){4, {10.0, -1.0, 10.0, 10.0}};
    assert_fault(WRITTEN_BARS, 0, "bar 1: [10, -1] is outside of the arena, whose size is [2000, 1500]");
    written.bar_count = 0;
    written.start = (struct written_entry){3, {10.0, 1501.0, 0.0}};
    assert_fault(WRITTEN_START, -1, "the start: [10, 1501] is outside of the arena, whose size is [2000, 1500]");
}

TEST(bar_shorter_than_its_thickness_is_refused)
{
    add_bar(1000.0, 1000.0, 1040.0, 1000.0);
    TEST_ASSERT_TRUE(is_valid());
    add_bar(1000.0, 2000.0, 1000.0, 2039.0);
    assert_fault(WRITTEN_BARS, 1, "bar 2 must be at least 40 mm long");
}

TEST(start_and_food_within_sensor_reach_are_refused)
{
    written.food[0].numbers[0] = 159.4;
    assert_fault(WRITTEN_FOOD, 0, "food 1 is only 159 mm away from an obstacle or a wall; 160 mm are needed");
    written.food[0].numbers[0] = 500.0;
    add_bar(400.0, 500.0, 600.0, 500.0);
    assert_fault(WRITTEN_FOOD, 0, "food 1 is inside an obstacle; 160 mm are needed");
    written.start = (struct written_entry){3, {50.0, 600.0, 0.0}};
    assert_fault(WRITTEN_START, -1, "the start is only 50 mm away from an obstacle or a wall; 160 mm are needed");
}

TEST(unreachable_food_is_refused)
{
    written.food[written.food_count++] = (struct written_entry){2, {3500.0, 500.0}};
    add_bar(2000.0, 0.0, 2000.0, 3000.0);
    assert_fault(WRITTEN_FOOD, 1, "food 2 cannot be reached from food 1: the robot does not fit through");
    written.start = (struct written_entry){3, {3000.0, 2000.0, 0.0}};
    assert_fault(WRITTEN_FOOD, 0, "food 1 cannot be reached from the start: the robot does not fit through");
    written.bars[0].numbers[1] = 300.0;
    TEST_ASSERT_TRUE(is_valid());
}

TEST(fault_text_starts_with_the_name_of_the_entry)
{
    TEST_ASSERT_FALSE(written_fails(&fault, WRITTEN_BARS, 2, " is %s, not %g", "7", 8.5));
    TEST_ASSERT_EQUAL_INT32(WRITTEN_BARS, fault.key);
    TEST_ASSERT_EQUAL_INT32(2, fault.entry);
    TEST_ASSERT_EQUAL_STRING("bar %g is 7, not %g", fault.text);
    TEST_ASSERT_EQUAL_UINT32(2, fault.value_count);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, fault.values[0]);
    TEST_ASSERT_EQUAL_DOUBLE(8.5, fault.values[1]);
}

TEST(message_that_begins_with_a_letter_has_no_prefix)
{
    (void)written_fails(&fault, WRITTEN_FOOD, -1, "it is so");
    TEST_ASSERT_EQUAL_STRING("it is so", fault.text);
    (void)written_fails(&fault, WRITTEN_FOOD, -1, ": so");
    TEST_ASSERT_EQUAL_STRING("food: so", fault.text);
    TEST_ASSERT_EQUAL_UINT32(0, fault.value_count);
}

TEST(message_of_a_written_world_is_cut_to_its_buffer)
{
    char text[2 * WRITTEN_TEXT_MAX] = "";

    memset(text, 'x', sizeof text - 1);
    (void)written_fails(&fault, WRITTEN_SIZE, -1, "a%s%s", text, text);
    TEST_ASSERT_EQUAL_size_t(WRITTEN_TEXT_MAX - 1, strlen(fault.text));
}

TEST(fault_values_beyond_the_array_are_dropped)
{
    (void)written_fails(&fault, WRITTEN_SIZE, -1, "a%g%g%g%g%g%g%g%g%g", 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0);
    TEST_ASSERT_EQUAL_UINT32(WRITTEN_VALUES_MAX, fault.value_count);
    TEST_ASSERT_EQUAL_DOUBLE(8.0, fault.values[WRITTEN_VALUES_MAX - 1]);
}
