#include "tests/test.h"
#include "host_sim/world/native/space/plain_near.h"
#include "host_sim/world/native/space/plain_space.h"

#include <string.h>

enum { COLUMNS = 4, ROWS = 3, CELLS = COLUMNS * ROWS, BODIES = 4 };

static uint32_t heads[CELLS], nexts[BODIES], cells[BODIES], near[PLAIN_NEAR_MAX];
static struct plain_grid grid;

BEFORE_EACH(plain_grid)
{
    memset(heads, 0, sizeof heads);
    memset(nexts, 0, sizeof nexts);
    memset(cells, 0, sizeof cells);
    grid = (struct plain_grid){.cell_mm = 500.0, .columns = COLUMNS, .rows = ROWS, .heads = heads, .nexts = nexts,
        .cells = cells};
}

static size_t near_to(double x, double y)
{
    return plain_grid_near(&grid, (struct vector){x, y}, near);
}

static void put(uint32_t body, double x, double y)
{
    plain_grid_put(&grid, body, (struct vector){x, y});
}

TEST(grid_cells_are_numbered_row_by_row)
{
    TEST_ASSERT_EQUAL_UINT32(0, plain_grid_cell(&grid, (struct vector){499.0, 0.0}));
    TEST_ASSERT_EQUAL_UINT32(1, plain_grid_cell(&grid, (struct vector){500.0, 499.0}));
    TEST_ASSERT_EQUAL_UINT32(6, plain_grid_cell(&grid, (struct vector){1001.0, 501.0}));
}

TEST(grid_maps_a_point_outside_to_the_nearest_cell)
{
    TEST_ASSERT_EQUAL_UINT32(0, plain_grid_cell(&grid, (struct vector){-5.0, -1e9}));
    TEST_ASSERT_EQUAL_UINT32(CELLS - 1, plain_grid_cell(&grid, (struct vector){2000.0, 1e12}));
}

TEST(grid_border_distance_is_to_the_nearest_side)
{
    TEST_ASSERT_EQUAL_DOUBLE(100.0, plain_grid_border_mm(&grid, (struct vector){600.0, 250.0}));
    TEST_ASSERT_EQUAL_DOUBLE(50.0, plain_grid_border_mm(&grid, (struct vector){750.0, 450.0}));
}

TEST(grid_finds_bodies_in_neighbouring_cells)
{
    put(0, 10.0, 10.0);
    put(1, 990.0, 990.0);
    put(2, 1500.0, 10.0);
    TEST_ASSERT_EQUAL_size_t(2, near_to(10.0, 10.0));
    TEST_ASSERT_EQUAL_size_t(2, near_to(990.0, 990.0));
    TEST_ASSERT_EQUAL_size_t(2, near_to(1400.0, 10.0));
    TEST_ASSERT_EQUAL_size_t(1, near_to(1999.0, 400.0));
    TEST_ASSERT_EQUAL_UINT32(2, near[0]);
}

TEST(moved_body_leaves_its_cell)
{
    for (uint32_t body = 0; body < BODIES; body++)
        put(body, 10.0, 10.0);
    put(1, 20.0, 20.0);
    put(2, 1600.0, 1400.0);
    TEST_ASSERT_EQUAL_size_t(3, near_to(0.0, 0.0));
    put(3, 1600.0, 1400.0);
    put(0, 1600.0, 1400.0);
    TEST_ASSERT_EQUAL_size_t(1, near_to(0.0, 0.0));
    TEST_ASSERT_EQUAL_UINT32(1, near[0]);
    TEST_ASSERT_EQUAL_size_t(3, near_to(1999.0, 1499.0));
}

enum { NEAR_BODIES = 3, CAPSULES = 3, NEAR_CELLS = 2 };

static uint32_t bodies_near[PLAIN_NEAR_MAX];
static struct plain_world space;
static struct body bodies[NEAR_BODIES];
static struct world world;

/* Capsules 0 and 2 can be felt in the left cell, 1 in the right one. */
BEFORE_EACH(plain_near)
{
    static const uint32_t firsts[NEAR_CELLS + 1] = {0, 2, 3}, numbers[CAPSULES] = {0, 2, 1};

    for (unsigned i = 0; i < NEAR_CELLS; i++)
        heads[i] = 0;
    for (unsigned i = 0; i < NEAR_BODIES; i++)
        nexts[i] = cells[i] = 0;
    grid = (struct plain_grid){500.0, NEAR_CELLS, 1, firsts, numbers, heads, nexts, cells};
    space = (struct plain_world){.capsule_count = CAPSULES, .grid = &grid};
    world = (struct world){.space = &space.space, .body_count = NEAR_BODIES, .bodies = bodies};
}

TEST(plain_near_returns_all_without_a_grid)
{
    struct plain_choice all;

    space.grid = NULL;
    all = plain_near_capsules(&space, (struct vector){600.0, 10.0});
    TEST_ASSERT_EQUAL_size_t(CAPSULES, all.count);
    TEST_ASSERT_EQUAL_size_t(2, plain_chosen(&all, 2));
    TEST_ASSERT_EQUAL_size_t(NEAR_BODIES, plain_near_bodies(&world, (struct vector){600.0, 10.0}, bodies_near));
    TEST_ASSERT_EQUAL_UINT32(2, bodies_near[2]);
}

TEST(plain_near_returns_the_capsules_of_a_cell)
{
    const struct plain_choice left = plain_near_capsules(&space, (struct vector){499.0, 10.0});
    const struct plain_choice right = plain_near_capsules(&space, (struct vector){501.0, 10.0});

    TEST_ASSERT_EQUAL_size_t(2, left.count);
    TEST_ASSERT_EQUAL_size_t(2, plain_chosen(&left, 1));
    TEST_ASSERT_EQUAL_size_t(1, right.count);
    TEST_ASSERT_EQUAL_size_t(1, plain_chosen(&right, 0));
}

TEST(plain_near_returns_bodies_in_neighbouring_cells)
{
    plain_grid_put(&grid, 1, (struct vector){10.0, 10.0});
    TEST_ASSERT_EQUAL_size_t(1, plain_near_bodies(&world, (struct vector){600.0, 10.0}, bodies_near));
    TEST_ASSERT_EQUAL_UINT32(1, bodies_near[0]);
}

TEST(plain_position_is_the_centre_of_a_body)
{
    const struct body body = {.x_mm = 3.0, .y_mm = 4.0};

    TEST_ASSERT_EQUAL_DOUBLE(3.0, plain_position(&body).x);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, plain_position(&body).y);
}
