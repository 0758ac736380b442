#include "host_sim/world/native/draw/layout.h"
#include "tests/test.h"

#include <math.h>

/* An arena of 8 columns and 6 rows, in which a tiny body keeps to the middles at least a cell off the walls: 6 and 4. */
enum { COLUMNS = 10, ROWS = 8, CELLS = COLUMNS * ROWS };

static const double ROOM_MM = REACH_CELL_MM, BODY_MM = 25.0 - 25.0 * 0.70710678118654752;

static struct bar bar;
static struct plant plant;
static struct obstacles obstacles;
static uint8_t cells[CELLS];
static uint32_t stack[CELLS];
static struct reach reach;

static struct vector middle(unsigned row, unsigned column)
{
    return (struct vector){(column - 0.5) * REACH_CELL_MM, (row - 0.5) * REACH_CELL_MM};
}

void setUp(void)
{
    bar = (struct bar){{100.0, 0.0}, {100.0, 150.0}};
    plant = (struct plant){.at = middle(3, 4), .radius_mm = 10.0};
    obstacles = (struct obstacles){.width_mm = 200.0, .height_mm = 150.0, .bar_radius_mm = 5.0, .bars = &bar, .plants = &plant};
    reach = (struct reach){.cells = cells, .stack = stack};
}

static unsigned set(void)
{
    unsigned count = 0;

    for (unsigned i = 0; i < CELLS; i++)
        count += cells[i];
    return count;
}

static unsigned reached(unsigned row, unsigned column)
{
    reach_find(&reach, &obstacles, BODY_MM, middle(row, column));
    return set();
}

TEST(an_arena_has_its_cells_and_a_border)
{
    TEST_ASSERT_EQUAL_size_t(CELLS, reach_size(200.0, 150.0));
    TEST_ASSERT_EQUAL_size_t(CELLS + COLUMNS, reach_size(200.0, 150.5));
}

TEST(all_cells_off_the_walls_are_reached)
{
    TEST_ASSERT_EQUAL_UINT(24, reached(2, 2));
    TEST_ASSERT_TRUE(reach_has(&reach, middle(5, 7)));
    TEST_ASSERT_FALSE(reach_has(&reach, middle(6, 7)));
    TEST_ASSERT_FALSE(reach_has(&reach, middle(5, 8)));
}

TEST(nothing_is_reached_from_a_blocked_cell)
{
    TEST_ASSERT_EQUAL_UINT(0, reached(1, 1));
    TEST_ASSERT_TRUE(isinf(reach_distance_mm(&reach, middle(2, 2))));
}

TEST(a_bar_across_the_arena_parts_it)
{
    obstacles.bar_count = 1;
    TEST_ASSERT_EQUAL_UINT(8, reached(2, 2));
    TEST_ASSERT_FALSE(reach_has(&reach, middle(2, 4)));
    TEST_ASSERT_EQUAL_UINT(8, reached(2, 7));
}

TEST(a_cell_exactly_at_the_limit_is_free)
{
    bar = (struct bar){{0.0, 67.5}, {200.0, 67.5}};   /* its face is 25 mm off the middles of row 2 */
    obstacles.bar_count = 1;
    TEST_ASSERT_EQUAL_UINT(6, reached(2, 2));
    bar.a.y = bar.b.y = 67.499;
    TEST_ASSERT_EQUAL_UINT(0, reached(2, 2));
}

TEST(a_plant_blocks_the_cells_around_it)
{
    obstacles.plant_count = 1;
    TEST_ASSERT_EQUAL_UINT(24 - 5, reached(2, 2));
    TEST_ASSERT_FALSE(reach_has(&reach, middle(3, 4)));
    TEST_ASSERT_TRUE(reach_has(&reach, middle(2, 3)));
}

TEST(cells_without_more_room_can_be_left_out)
{
    (void)reached(2, 2);
    reach_keep_clear(&reach, &obstacles, ROOM_MM + REACH_CELL_MM);
    TEST_ASSERT_EQUAL_UINT(8, set());
}

TEST(the_nearest_middle_counts_as_the_distance)
{
    struct vector beside = middle(2, 2);

    (void)reached(2, 2);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, reach_distance_mm(&reach, beside));
    beside.x -= 3.0;
    beside.y -= 4.0;
    TEST_ASSERT_EQUAL_DOUBLE(5.0, reach_distance_mm(&reach, beside));
}

TEST(a_cell_has_a_middle)
{
    (void)reached(2, 2);
    TEST_ASSERT_EQUAL_DOUBLE(middle(3, 5).x, reach_middle(&reach, 3 * COLUMNS + 5).x);
    TEST_ASSERT_EQUAL_DOUBLE(middle(3, 5).y, reach_middle(&reach, 3 * COLUMNS + 5).y);
}
