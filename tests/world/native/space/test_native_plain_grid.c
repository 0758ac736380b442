#include "host_sim/world/native/space/plain_space.h"

#include <string.h>

#include "tests/test.h"

enum { COLUMNS = 4, ROWS = 3, CELLS = COLUMNS * ROWS, BODIES = 4 };

static uint32_t heads[CELLS], nexts[BODIES], cells[BODIES], near[PLAIN_NEAR_MAX];
static struct plain_grid grid;

void setUp(void)
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

TEST(cells_go_row_by_row)
{
    TEST_ASSERT_EQUAL_UINT32(0, plain_grid_cell(&grid, (struct vector){499.0, 0.0}));
    TEST_ASSERT_EQUAL_UINT32(1, plain_grid_cell(&grid, (struct vector){500.0, 499.0}));
    TEST_ASSERT_EQUAL_UINT32(6, plain_grid_cell(&grid, (struct vector){1001.0, 501.0}));
}

TEST(a_place_outside_belongs_to_the_nearest_cell)
{
    TEST_ASSERT_EQUAL_UINT32(0, plain_grid_cell(&grid, (struct vector){-5.0, -1e9}));
    TEST_ASSERT_EQUAL_UINT32(CELLS - 1, plain_grid_cell(&grid, (struct vector){2000.0, 1e12}));
}

TEST(the_border_is_as_far_as_its_nearest_side)
{
    TEST_ASSERT_EQUAL_DOUBLE(100.0, plain_grid_border_mm(&grid, (struct vector){600.0, 250.0}));
    TEST_ASSERT_EQUAL_DOUBLE(50.0, plain_grid_border_mm(&grid, (struct vector){750.0, 450.0}));
}

TEST(bodies_are_found_from_the_cells_around)
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

TEST(a_body_that_moves_leaves_its_cell)
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
