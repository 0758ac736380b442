#include "host_sim/world/native/draw/layouts.h"
#include "tests/test.h"

#include <math.h>
#include <string.h>

enum { CELLS = 19764, ROBOTS = 200 };

static struct layout_kind kind;
static struct pose starts[ROBOTS];
static struct layout layout;
static uint8_t cells[CELLS];
static uint32_t stack[CELLS];
static struct reach reach;

void setUp(void)
{
    kind = (struct layout_kind){.params = {
        .width_mm = 4000.0, .height_mm = 3000.0, .body_radius_mm = 100.0, .sensor_reach_mm = 60.0, .bar_thickness_mm = 40.0,
        .bar_min_mm = 300.0, .bar_max_mm = 1000.0,
        .food_min_mm = {0.0, 1150.0, 2750.0}, .food_max_mm = {1000.0, 2750.0, 4000.0},
        .bar_count = 6, .food_count = 3,
    }};
    memset(starts, 0, sizeof starts);
    memset(&layout, 0, sizeof layout);
    layout.starts = starts;
    reach = (struct reach){.cells = cells, .stack = stack};
}

static bool drawn(int64_t seed, int64_t number, uint32_t robots)
{
    struct layout_which which = {seed, number, robots};

    return layouts_draw(&kind, &which, &reach, &layout);
}

static void expect_start(double x, double y)
{
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, x, starts[0].at.x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, y, starts[0].at.y);
}

TEST(an_arena_of_this_size_has_as_many_cells)
{
    TEST_ASSERT_EQUAL_size_t(CELLS, reach_size(4000.0, 3000.0));
}

TEST(a_seed_and_a_number_have_one_layout)
{
    TEST_ASSERT_TRUE(drawn(1, 1, 1));
    expect_start(314.651908, 385.035638);
    TEST_ASSERT_TRUE(drawn(-1, 1, 1));
    expect_start(3192.063100, 359.192083);
    TEST_ASSERT_TRUE(drawn(INT64_MIN, INT64_MAX, 1));
    expect_start(1131.989504, 980.772647);
}

TEST(each_style_has_its_own)
{
    kind.style = LAYOUT_CORRIDORS;
    TEST_ASSERT_TRUE(drawn(1, 1, 1));
    TEST_ASSERT_EQUAL_UINT32(6, layout.bar_count);
    expect_start(2503.130587, 1695.199751);
    kind.style = LAYOUT_DEAD_ENDS;
    TEST_ASSERT_TRUE(drawn(1, 1, 1));
    TEST_ASSERT_EQUAL_UINT32(12, layout.bar_count);
    expect_start(463.793123, 2493.449056);
}

TEST(a_layout_is_fair)
{
    for (int64_t seed = 0; seed < 50; seed++) {
        struct obstacles obstacles;

        TEST_ASSERT_TRUE(drawn(seed, 1, 1));
        obstacles = layout_obstacles(&layout, &kind.params);
        reach_find(&reach, &obstacles, 100.0, starts[0].at);
        TEST_ASSERT_TRUE(clearance_suffices(&obstacles, starts[0].at, 160.0));
        for (unsigned i = 0; i < 3; i++) {
            TEST_ASSERT_TRUE(clearance_suffices(&obstacles, layout.food[i], 160.0));
            TEST_ASSERT_TRUE(reach_has(&reach, layout.food[i]));
        }
    }
}

TEST(more_robots_leave_the_rest_as_it_is)
{
    struct layout alone;
    struct pose first;

    TEST_ASSERT_TRUE(drawn(7, 2, 1));
    alone = layout;
    first = starts[0];
    TEST_ASSERT_TRUE(drawn(7, 2, 20));
    TEST_ASSERT_EQUAL_UINT32(20, layout.start_count);
    TEST_ASSERT_EQUAL_DOUBLE(first.at.x, starts[0].at.x);
    TEST_ASSERT_EQUAL_MEMORY(alone.bars, layout.bars, sizeof alone.bars);
    TEST_ASSERT_EQUAL_MEMORY(alone.food, layout.food, sizeof alone.food);
}

TEST(robots_start_out_of_reach_of_each_other)
{
    TEST_ASSERT_TRUE(drawn(3, 1, 20));
    for (unsigned i = 0; i < 20; i++)
        for (unsigned j = 0; j < i; j++)
            TEST_ASSERT_TRUE(hypot(starts[i].at.x - starts[j].at.x, starts[i].at.y - starts[j].at.y) >= 260.0);
}

TEST(where_there_is_no_room_for_all_fewer_start)
{
    TEST_ASSERT_TRUE(drawn(3, 1, ROBOTS));
    TEST_ASSERT_TRUE(layout.start_count > 20 && layout.start_count < ROBOTS);
}

TEST(a_world_that_is_too_small_has_no_fair_layout)
{
    kind.params.width_mm = kind.params.height_mm = 300.0;
    kind.params.bar_count = 0;
    TEST_ASSERT_FALSE(drawn(5, 3, 1));
}
