#include "host_sim/world/native/reach.h"
#include "tests/test.h"

/* Cells of 10 mm, free 10 mm off a bar or a wall: of six rows and eight columns the outermost are blocked. */
enum { ROWS = 6, COLUMNS = 8, STRIDE = COLUMNS + 2, CELLS = (ROWS + 2) * STRIDE };

static struct reach_bar bar;
static uint32_t stack[CELLS];
static uint8_t cells[CELLS];
static struct reach reach;

void setUp(void)
{
    reach = (struct reach){.width_mm = 80.0, .height_mm = 60.0, .cell_mm = 10.0, .bar_radius_mm = 2.0, .room_mm = 10.0,
        .rows = ROWS, .columns = COLUMNS, .bars = &bar, .stack = stack};
}

static unsigned reached(unsigned row, unsigned column)
{
    unsigned count = 0;

    reach_find(&reach, row * STRIDE + column, cells);
    for (unsigned i = 0; i < CELLS; i++)
        count += cells[i];
    return count;
}

TEST(all_cells_off_the_walls_are_reached)
{
    TEST_ASSERT_EQUAL_UINT(24, reached(2, 2));
    TEST_ASSERT_EQUAL_UINT8(1, cells[5 * STRIDE + 7]);
    TEST_ASSERT_EQUAL_UINT8(0, cells[6 * STRIDE + 7]);
}

TEST(nothing_is_reached_from_a_blocked_cell)
{
    TEST_ASSERT_EQUAL_UINT(0, reached(1, 1));
}

TEST(a_bar_across_the_arena_parts_it)
{
    bar = (struct reach_bar){.ax_mm = 40.0, .ay_mm = 0.0, .bx_mm = 40.0, .by_mm = 60.0};
    reach.bar_count = 1;
    TEST_ASSERT_EQUAL_UINT(8, reached(2, 2));
    TEST_ASSERT_EQUAL_UINT8(0, cells[2 * STRIDE + 4]);
    TEST_ASSERT_EQUAL_UINT(8, reached(2, 7));
}

TEST(a_cell_exactly_at_the_limit_is_free)
{
    bar = (struct reach_bar){.ax_mm = 0.0, .ay_mm = 27.0, .bx_mm = 80.0, .by_mm = 27.0};   /* its face is 10 mm off the middles of row 2 */
    reach.bar_count = 1;
    TEST_ASSERT_EQUAL_UINT(6, reached(2, 2));
    bar.ay_mm = bar.by_mm = 26.999;
    TEST_ASSERT_EQUAL_UINT(0, reached(2, 2));
}
