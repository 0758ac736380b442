/* Layouts that a page draws, and worlds that people write in it. */
#include "page_rig.h"
#include "tests/test.h"

static void set_numbers(void)
{
    static const double numbers[PAGE_DRAW_NUMBERS] = {
        [PAGE_DRAW_STYLE] = LAYOUT_BARS, [PAGE_DRAW_WIDTH_MM] = 4000.0, [PAGE_DRAW_HEIGHT_MM] = 3000.0,
        [PAGE_DRAW_BODY_MM] = 100.0, [PAGE_DRAW_REACH_MM] = 60.0, [PAGE_DRAW_THICKNESS_MM] = 40.0,
        [PAGE_DRAW_BAR_COUNT] = 6, [PAGE_DRAW_BAR_MIN_MM] = 300.0, [PAGE_DRAW_BAR_MAX_MM] = 1000.0,
        [PAGE_DRAW_FOOD_COUNT] = 3, [PAGE_DRAW_FOOD] = 0.0, 1000.0, 1150.0, 2750.0, 2750.0, 4000.0,
    };

    for (unsigned i = 0; i < PAGE_DRAW_NUMBERS; i++)
        page_drawing()[i] = numbers[i];
    page_write_nothing();
}

static void write_food(double x_mm, double y_mm)
{
    double *numbers = page_write_entry(WRITTEN_FOOD, 0, 2);

    page_write_list(WRITTEN_FOOD, 1);
    numbers[0] = x_mm;
    numbers[1] = y_mm;
}

static void expect_counts(const double *out, double first, double second, double third)
{
    TEST_ASSERT_EQUAL_DOUBLE(first, out[0]);
    TEST_ASSERT_EQUAL_DOUBLE(second, out[1]);
    TEST_ASSERT_EQUAL_DOUBLE(third, out[2]);
}

TEST(an_environment_is_drawn_and_handed_over)
{
    const double *out;

    set_numbers();
    out = page_draw(1, 1, PAGE_ROBOTS_MAX);
    expect_counts(out, 6.0, 3.0, 4.0);
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_DOUBLE_WITHIN(2000.0, 2000.0, out[3 + 4 * 6 + 2 * i]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 314.651908, out[3 + 4 * 6 + 2 * 3]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 385.035638, out[3 + 4 * 6 + 2 * 3 + 1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, -2.400630, out[3 + 4 * 6 + 2 * 3 + 2]);
}

TEST(the_style_and_the_bands_of_food_count)
{
    const double *out;

    set_numbers();
    page_drawing()[PAGE_DRAW_STYLE] = LAYOUT_DEAD_ENDS;
    page_drawing()[PAGE_DRAW_FOOD_COUNT] = 1;
    out = page_draw(1, 1, 1);
    expect_counts(out, 12.0, 1.0, 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(500.0, 500.0, out[3 + 4 * 12]);
}

TEST(a_written_world_takes_the_place_of_the_style)
{
    double *bar;
    const double *out;

    set_numbers();
    write_food(3500.0, 400.0);
    bar = page_write_entry(WRITTEN_BARS, 0, 4);
    page_write_list(WRITTEN_BARS, 1);
    bar[0] = bar[1] = bar[2] = 1000.0;
    bar[3] = 2000.0;
    TEST_ASSERT_NULL(page_check());
    out = page_draw(1, 1, 2);
    expect_counts(out, 1.0, 1.0, 2.0);
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, out[3 + 3]);
    TEST_ASSERT_EQUAL_DOUBLE(3500.0, out[3 + 4]);
    page_write_nothing();
    expect_counts(page_draw(1, 1, 1), 6.0, 3.0, 1.0);
}

TEST(a_fault_of_a_written_world_is_told)
{
    const double *out;

    set_numbers();
    write_food(100.0, 400.0);
    out = page_check();
    expect_counts(out, WRITTEN_FOOD, 0.0, 3.0);
    TEST_ASSERT_EQUAL_STRING("food %g is only %g mm away from an obstacle or a wall; %g mm are needed", page_fault_text());
    TEST_ASSERT_EQUAL_DOUBLE(1.0, out[3]);
    TEST_ASSERT_EQUAL_DOUBLE(100.0, out[4]);
    TEST_ASSERT_EQUAL_DOUBLE(160.0, out[5]);
    TEST_ASSERT_NULL(page_write_entry(WRITTEN_FOOD, WRITTEN_FOOD_MAX, 2));
}

TEST(a_world_without_room_has_no_starts)
{
    set_numbers();
    page_drawing()[PAGE_DRAW_WIDTH_MM] = page_drawing()[PAGE_DRAW_HEIGHT_MM] = 300.0;
    page_drawing()[PAGE_DRAW_BAR_COUNT] = 0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, page_draw(1, 1, 1)[2]);
}
