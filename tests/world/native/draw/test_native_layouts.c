#include "tests/test.h"
#include "host_sim/world/native/draw/layout.h"
#include "host_sim/world/native/draw/tour.h"

#include <math.h>
#include <string.h>

enum { CELLS = 19764, ROBOTS = 200 };

static struct layout_kind kind;
static struct pose starts[ROBOTS];
static struct layout layout;
static uint8_t cells[CELLS];
static uint32_t stack[CELLS];
static struct reach reach;

BEFORE_EACH(layouts)
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

TEST(reach_size_of_4_by_3_m_is_19764_cells)
{
    TEST_ASSERT_EQUAL_size_t(CELLS, reach_size(4000.0, 3000.0));
}

TEST(layout_depends_only_on_seed_and_number)
{
    TEST_ASSERT_TRUE(drawn(1, 1, 1));
    expect_start(314.651908, 385.035638);
    TEST_ASSERT_TRUE(drawn(-1, 1, 1));
    expect_start(3192.063100, 359.192083);
    TEST_ASSERT_TRUE(drawn(INT64_MIN, INT64_MAX, 1));
    expect_start(1131.989504, 980.772647);
}

TEST(styles_draw_different_layouts)
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

TEST(drawn_food_is_clear_and_reachable)
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

TEST(robot_count_does_not_change_bars_and_food)
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

TEST(fewer_robots_start_when_room_runs_out)
{
    TEST_ASSERT_TRUE(drawn(3, 1, ROBOTS));
    TEST_ASSERT_TRUE(layout.start_count > 20 && layout.start_count < ROBOTS);
}

TEST(world_that_is_too_small_has_no_layout)
{
    kind.params.width_mm = kind.params.height_mm = 300.0;
    kind.params.bar_count = 0;
    TEST_ASSERT_FALSE(drawn(5, 3, 1));
}

/* An arena of 8 columns and 6 rows, in which a tiny body keeps to the middles at least a cell off the walls: 6 and 4. */
enum { COLUMNS = 10, ROWS = 8, GRID_CELLS = COLUMNS * ROWS };

static const double ROOM_MM = REACH_CELL_MM, BODY_MM = 25.0 - 25.0 * 0.70710678118654752;

static struct bar bar;
static struct plant plant;
static struct obstacles obstacles;
static uint8_t grid_cells[GRID_CELLS];
static uint32_t grid_stack[GRID_CELLS];

static struct vector middle(unsigned row, unsigned column)
{
    return (struct vector){(column - 0.5) * REACH_CELL_MM, (row - 0.5) * REACH_CELL_MM};
}

BEFORE_EACH(reach)
{
    bar = (struct bar){{100.0, 0.0}, {100.0, 150.0}};
    plant = (struct plant){.at = middle(3, 4), .radius_mm = 10.0};
    obstacles = (struct obstacles){.width_mm = 200.0, .height_mm = 150.0, .bar_radius_mm = 5.0, .bars = &bar, .plants = &plant};
    reach = (struct reach){.cells = grid_cells, .stack = grid_stack};
}

static unsigned set(void)
{
    unsigned count = 0;

    for (unsigned i = 0; i < GRID_CELLS; i++)
        count += grid_cells[i];
    return count;
}

static unsigned reached(unsigned row, unsigned column)
{
    reach_find(&reach, &obstacles, BODY_MM, middle(row, column));
    return set();
}

TEST(reach_size_includes_a_border)
{
    TEST_ASSERT_EQUAL_size_t(GRID_CELLS, reach_size(200.0, 150.0));
    TEST_ASSERT_EQUAL_size_t(GRID_CELLS + COLUMNS, reach_size(200.0, 150.5));
}

TEST(reach_finds_all_cells_clear_of_walls)
{
    TEST_ASSERT_EQUAL_UINT(24, reached(2, 2));
    TEST_ASSERT_TRUE(reach_has(&reach, middle(5, 7)));
    TEST_ASSERT_FALSE(reach_has(&reach, middle(6, 7)));
    TEST_ASSERT_FALSE(reach_has(&reach, middle(5, 8)));
}

TEST(blocked_cell_reaches_no_cell)
{
    TEST_ASSERT_EQUAL_UINT(0, reached(1, 1));
    TEST_ASSERT_TRUE(isinf(reach_distance_mm(&reach, middle(2, 2))));
}

TEST(bar_across_the_arena_divides_the_cells)
{
    obstacles.bar_count = 1;
    TEST_ASSERT_EQUAL_UINT(8, reached(2, 2));
    TEST_ASSERT_FALSE(reach_has(&reach, middle(2, 4)));
    TEST_ASSERT_EQUAL_UINT(8, reached(2, 7));
}

TEST(cell_exactly_at_the_clearance_is_free)
{
    bar = (struct bar){{0.0, 67.5}, {200.0, 67.5}};   /* its face is 25 mm off the middles of row 2 */
    obstacles.bar_count = 1;
    TEST_ASSERT_EQUAL_UINT(6, reached(2, 2));
    bar.a.y = bar.b.y = 67.499;
    TEST_ASSERT_EQUAL_UINT(0, reached(2, 2));
}

TEST(plant_blocks_the_cells_around_it)
{
    obstacles.plant_count = 1;
    TEST_ASSERT_EQUAL_UINT(24 - 5, reached(2, 2));
    TEST_ASSERT_FALSE(reach_has(&reach, middle(3, 4)));
    TEST_ASSERT_TRUE(reach_has(&reach, middle(2, 3)));
}

TEST(reach_keep_clear_removes_cells_with_less_clearance)
{
    (void)reached(2, 2);
    reach_keep_clear(&reach, &obstacles, ROOM_MM + REACH_CELL_MM);
    TEST_ASSERT_EQUAL_UINT(8, set());
}

TEST(reach_distance_is_to_the_nearest_cell_centre)
{
    struct vector beside = middle(2, 2);

    (void)reached(2, 2);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, reach_distance_mm(&reach, beside));
    beside.x -= 3.0;
    beside.y -= 4.0;
    TEST_ASSERT_EQUAL_DOUBLE(5.0, reach_distance_mm(&reach, beside));
}

TEST(reach_middle_is_the_centre_of_a_cell)
{
    (void)reached(2, 2);
    TEST_ASSERT_EQUAL_DOUBLE(middle(3, 5).x, reach_middle(&reach, 3 * COLUMNS + 5).x);
    TEST_ASSERT_EQUAL_DOUBLE(middle(3, 5).y, reach_middle(&reach, 3 * COLUMNS + 5).y);
}

enum { TANGENTS = 4000 };

static const double PI = 3.14159265358979323846;

/* An arena of 4 by 3 metres with a body of 100 mm and bars of 40 mm: the centre keeps 120 mm off a bar's line. */
static const double TOUR_BODY_MM = 100.0, TOUR_ROOM_MM = 120.0;

static struct tour_tangent tangents[TANGENTS];
static struct tour tour;
static struct bar bars[TOUR_THINGS_MAX + 1];
static struct vector places[TOUR_PLACES_MAX + 1];

BEFORE_EACH(tour)
{
    tour = (struct tour){.tangents = tangents, .tangents_max = TANGENTS};
    obstacles = (struct obstacles){.width_mm = 4000.0, .height_mm = 3000.0, .bar_radius_mm = 20.0, .bars = bars, .plants = &plant};
    places[0] = (struct vector){1000.0, 1500.0};
    places[1] = (struct vector){3000.0, 1500.0};
}

static double way_mm(uint32_t count)
{
    return tour_mm(&tour, &obstacles, TOUR_BODY_MM, places, count);
}

/* Around a circle that is right between the places: two tangents and the arc between them. */
static double around_mm(double half_mm, double radius_mm)
{
    return 2.0 * (sqrt(half_mm * half_mm - radius_mm * radius_mm) + radius_mm * asin(radius_mm / half_mm));
}

TEST(tour_without_obstacles_is_straight)
{
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, way_mm(2));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, way_mm(1));
}

TEST(shortest_tour_visits_food_in_the_best_order)
{
    places[1] = (struct vector){3000.0, 1500.0};
    places[2] = (struct vector){500.0, 1500.0};
    places[3] = (struct vector){2000.0, 1500.0};
    TEST_ASSERT_EQUAL_DOUBLE(500.0 + 2500.0, way_mm(4));
}

TEST(tour_goes_around_a_plant)
{
    plant = (struct plant){{2000.0, 1500.0}, 80.0};
    obstacles.plant_count = 1;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, around_mm(1000.0, 180.0), way_mm(2));
}

TEST(tour_goes_around_the_nearer_end_of_a_bar)
{
    bars[0] = (struct bar){{2000.0, 1500.0}, {2000.0, 2500.0}};
    obstacles.bar_count = 1;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, around_mm(1000.0, TOUR_ROOM_MM), way_mm(2));
}

TEST(tour_goes_around_both_ends_of_a_bar_along_it)
{
    bars[0] = (struct bar){{1500.0, 1500.0}, {2500.0, 1500.0}};
    obstacles.bar_count = 1;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, around_mm(500.0, TOUR_ROOM_MM) + 1000.0, way_mm(2));
}

TEST(tour_through_a_gap_that_is_too_narrow_is_infinite)
{
    bars[0] = (struct bar){{2000.0, 0.0}, {2000.0, 2781.0}};   /* 3000 less twice the body and half the bar is 2780 */
    obstacles.bar_count = 1;
    TEST_ASSERT_TRUE(isinf(way_mm(2)));
    bars[0].b.y = 2779.0;
    TEST_ASSERT_TRUE(way_mm(2) > 2.0 * 1200.0);
}

TEST(tour_avoids_an_arc_blocked_by_another_bar)
{
    double free_mm;

    bars[0] = (struct bar){{2000.0, 1400.0}, {2000.0, 2900.0}};
    bars[1] = (struct bar){{2000.0, 0.0}, {2000.0, 1200.0}};   /* leaves 160 mm between their faces */
    obstacles.bar_count = 1;
    free_mm = way_mm(2);
    obstacles.bar_count = 2;
    TEST_ASSERT_TRUE(free_mm < 2100.0);
    TEST_ASSERT_TRUE(isinf(way_mm(2)));
}

TEST(tour_may_follow_a_circle_over_half_a_turn)
{
    plant = (struct plant){{1000.0, 1500.0 - 190.0}, 80.0};   /* 10 mm off the start, which leaves along its tangent or not */
    places[1] = (struct vector){1000.0, 500.0};
    obstacles.plant_count = 1;
    TEST_ASSERT_TRUE(way_mm(2) > 1000.0);
    TEST_ASSERT_TRUE(way_mm(2) < 810.0 + 180.0 * PI);
}

TEST(tour_beyond_its_limits_is_infinite)
{
    for (uint32_t i = 0; i <= TOUR_PLACES_MAX; i++)
        places[i] = (struct vector){300.0 * (i + 1), 300.0};
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 300.0 * (TOUR_PLACES_MAX - 1), way_mm(TOUR_PLACES_MAX));
    TEST_ASSERT_TRUE(isinf(way_mm(TOUR_PLACES_MAX + 1)));
    obstacles.bar_count = TOUR_THINGS_MAX + 1;
    TEST_ASSERT_TRUE(isinf(way_mm(2)));
    obstacles.bar_count = 0;
    tour.tangents_max = 2;   /* there and back fill it */
    TEST_ASSERT_TRUE(isinf(way_mm(2)));
}
