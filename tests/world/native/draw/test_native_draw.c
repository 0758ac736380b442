/* The draws of each style: where things are, and that they differ from draw to draw. */
#include "host_sim/world/native/draw/draw.h"

#include <math.h>

#include "host_sim/world/native/draw/written.h"
#include "tests/test.h"

enum { LAYOUTS = 50 };

static const struct layout_params PARAMS = {
    .width_mm = 4000.0, .height_mm = 3000.0, .body_radius_mm = 100.0, .sensor_reach_mm = 60.0, .bar_thickness_mm = 40.0,
    .bar_min_mm = 300.0, .bar_max_mm = 1000.0, .food_min_mm = {0.0, 2000.0}, .food_max_mm = {2000.0, 4000.0},
    .bar_count = 6, .food_count = 2,
};

static struct draws draws;
static struct pose start;
static struct layout layout;
static struct written written;
static uint8_t cells[WRITTEN_CELLS_MAX];
static uint32_t stack[WRITTEN_CELLS_MAX];
static struct reach reach;

void setUp(void)
{
    draws_seed(&draws, "test");
    layout = (struct layout){.starts = &start};
    reach = (struct reach){.cells = cells, .stack = stack};
    written_clear(&written);
    written.food_count = written.bar_count = 1;
    written.food[0] = (struct written_entry){2, {500.0, 500.0}};
    written.bars[0] = (struct written_entry){4, {2000.0, 0.0, 2000.0, 3000.0}};
}

static double length(struct bar bar)
{
    return hypot(bar.b.x - bar.a.x, bar.b.y - bar.a.y);
}

static bool is_inside(struct vector at, double edge)
{
    return at.x >= edge && at.x <= PARAMS.width_mm - edge && at.y >= edge && at.y <= PARAMS.height_mm - edge;
}

static void expect_inside(double edge)
{
    for (uint32_t i = 0; i < layout.bar_count; i++) {
        TEST_ASSERT_TRUE(is_inside(layout.bars[i].a, edge));
        TEST_ASSERT_TRUE(is_inside(layout.bars[i].b, edge));
    }
}

TEST(a_pose_is_drawn_x_first_and_the_heading_last)
{
    struct draws again = draws;
    struct pose pose = draw_pose(&draws, &PARAMS);
    double x = draws_between(&again, 0.0, 4000.0), y = draws_between(&again, 0.0, 3000.0);
    double heading = draws_between(&again, -DRAW_PI, DRAW_PI);

    TEST_ASSERT_EQUAL_DOUBLE(x, pose.at.x);
    TEST_ASSERT_EQUAL_DOUBLE(y, pose.at.y);
    TEST_ASSERT_EQUAL_DOUBLE(heading, pose.heading_rad);
}

TEST(each_piece_of_food_is_in_its_band)
{
    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_food_and_start(&draws, &PARAMS, &layout);
        TEST_ASSERT_EQUAL_UINT32(2, layout.food_count);
        TEST_ASSERT_EQUAL_UINT32(1, layout.start_count);
        TEST_ASSERT_TRUE(layout.food[0].x < 2000.0 && layout.food[1].x >= 2000.0);
        TEST_ASSERT_TRUE(is_inside(layout.food[0], 0.0) && is_inside(layout.food[1], 0.0) && is_inside(start.at, 0.0));
    }
}

TEST(bars_are_as_long_as_they_may_be_and_inside_the_walls)
{
    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_bars(&draws, &PARAMS, &layout);
        TEST_ASSERT_EQUAL_UINT32(6, layout.bar_count);
        expect_inside(20.0 - 1e-9);
        for (unsigned i = 0; i < 6; i++)
            TEST_ASSERT_DOUBLE_WITHIN(350.0 + 1e-9, 650.0 - 40.0, length(layout.bars[i]));
    }
}

TEST(corridors_are_parallel_walls_with_a_door_in_each)
{
    unsigned upright = 0;

    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_corridors(&draws, &PARAMS, &layout);
        upright += layout.bars[0].a.x == layout.bars[0].b.x;
        TEST_ASSERT_EQUAL_UINT32(layout.bars[0].a.x == layout.bars[0].b.x ? 8 : 6, layout.bar_count);
        for (unsigned i = 0; i < layout.bar_count; i += 2) {
            struct bar door = {layout.bars[i].b, layout.bars[i + 1].a};

            TEST_ASSERT_DOUBLE_WITHIN(100.0, 550.0, length(door));
            TEST_ASSERT_EQUAL_DOUBLE(0.0, fmin(layout.bars[i].a.x, layout.bars[i].a.y));
        }
    }
    TEST_ASSERT_TRUE(upright > 0 && upright < LAYOUTS);
}

TEST(a_very_long_arena_has_no_more_walls_than_there_is_room_for)
{
    struct layout_params params = PARAMS;

    params.width_mm = params.height_mm = 1e6;
    draw_corridors(&draws, &params, &layout);
    TEST_ASSERT_EQUAL_UINT32(LAYOUT_BARS_MAX, layout.bar_count);
}

TEST(dead_ends_are_pockets_that_are_open_on_one_side)
{
    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_dead_ends(&draws, &PARAMS, &layout);
        TEST_ASSERT_EQUAL_UINT32(12, layout.bar_count);
        expect_inside(20.0);
        for (unsigned i = 0; i < 12; i += 3) {
            TEST_ASSERT_DOUBLE_WITHIN(110.0, 490.0, length(layout.bars[i]));
            TEST_ASSERT_DOUBLE_WITHIN(200.0, 600.0, length(layout.bars[i + 1]));
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, length(layout.bars[i + 1]), length(layout.bars[i + 2]));
            TEST_ASSERT_EQUAL_DOUBLE(layout.bars[i].a.x, layout.bars[i + 1].a.x);
            TEST_ASSERT_EQUAL_DOUBLE(layout.bars[i].b.x, layout.bars[i + 2].a.x);
        }
    }
}

static void draw_as_written(void)
{
    struct layout_kind kind = {.style = LAYOUT_WRITTEN, .params = PARAMS, .written = &written};

    draw_written(&draws, &kind, &reach, &layout);
}

TEST(what_was_written_is_laid_out)
{
    draw_as_written();
    TEST_ASSERT_EQUAL_UINT32(1, layout.bar_count);
    TEST_ASSERT_EQUAL_UINT32(1, layout.food_count);
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, layout.bars[0].a.x);
    TEST_ASSERT_EQUAL_DOUBLE(3000.0, layout.bars[0].b.y);
    TEST_ASSERT_EQUAL_DOUBLE(500.0, layout.food[0].x);
}

TEST(a_written_start_has_its_heading_in_degrees)
{
    written.start = (struct written_entry){3, {700.0, 800.0, 450.0}};
    draw_as_written();
    TEST_ASSERT_EQUAL_DOUBLE(700.0, start.at.x);
    TEST_ASSERT_EQUAL_DOUBLE(800.0, start.at.y);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, DRAW_PI / 2, start.heading_rad);
}

TEST(a_start_that_is_not_written_is_drawn_where_it_is_fair)
{
    double least = 4000.0, most = 0.0;

    for (unsigned n = 0; n < LAYOUTS; n++) {
        draw_as_written();
        TEST_ASSERT_TRUE(start.at.x >= 160.0 && start.at.x <= 1820.0);   /* on its side of the bar */
        TEST_ASSERT_TRUE(start.at.y >= 160.0 && start.at.y <= 2840.0);
        least = fmin(least, start.at.x);
        most = fmax(most, start.at.x);
    }
    TEST_ASSERT_TRUE(least < 500.0 && most > 1500.0);
}

TEST(where_only_the_food_has_room_the_robot_starts_there)
{
    struct layout_params params = PARAMS;
    struct layout_kind kind = {.style = LAYOUT_WRITTEN, .params = params, .written = &written};

    kind.params.width_mm = kind.params.height_mm = 320.0;
    written.bar_count = 0;
    written.food[0] = (struct written_entry){2, {160.0, 160.0}};
    draw_written(&draws, &kind, &reach, &layout);
    TEST_ASSERT_EQUAL_DOUBLE(160.0, start.at.x);
    TEST_ASSERT_EQUAL_DOUBLE(160.0, start.at.y);
}
