#include "host_sim/world/native/space/plain_near.h"
#include "tests/test.h"
#include "host_sim/world/native/space/plain_space.h"

enum { BODIES = 2, COLUMNS = 8 };

static struct body bodies[BODIES];
static struct capsule bar;
static struct plain_world space;
static struct world world;

/* Two bodies, one below the other, and a bar at x = 2000. */
void setUp(void)
{
    for (unsigned i = 0; i < BODIES; i++)
        bodies[i] = (struct body){.x_mm = 1000.0, .y_mm = 1000.0 + 1000.0 * i};
    capsule_set(&bar, (struct vector){2000.0, 500.0}, (struct vector){2000.0, 1500.0}, 20.0);
    space = (struct plain_world){.body_radius_mm = 100.0, .capsule_count = 1, .capsules = &bar};
    world = (struct world){.space = &space.space, .body_count = BODIES, .bodies = bodies};
}

static bool is_hidden(double x_mm, double y_mm)
{
    return plain_view_hides(&world, &bodies[0], (struct vector){x_mm, y_mm});
}

TEST(a_bar_hides_what_is_behind_it)
{
    TEST_ASSERT_TRUE(is_hidden(2500.0, 1000.0));
    TEST_ASSERT_FALSE(is_hidden(1900.0, 1000.0));
    TEST_ASSERT_FALSE(is_hidden(2500.0, 100.0));
}

TEST(another_body_hides_what_is_behind_it)
{
    TEST_ASSERT_TRUE(is_hidden(1000.0, 2500.0));
    TEST_ASSERT_FALSE(is_hidden(1000.0, 500.0));
}

TEST(a_lifted_body_hides_nothing)
{
    bodies[1].lifted = true;
    TEST_ASSERT_FALSE(is_hidden(1000.0, 2500.0));
}

TEST(a_body_does_not_hide_what_it_stands_on)
{
    TEST_ASSERT_FALSE(is_hidden(1000.0, 1000.0));
}

TEST(with_a_grid_the_cells_along_the_way_are_searched)
{
    static const uint32_t firsts[COLUMNS + 1] = {0, 0, 0, 0, 1, 2, 2, 2, 2}, numbers[] = {0, 0};
    static uint32_t heads[COLUMNS], nexts[BODIES], cells[BODIES];
    static struct plain_grid grid = {500.0, COLUMNS, 1, firsts, numbers, heads, nexts, cells};

    space.grid = &grid;
    bodies[1].x_mm = 3000.0;
    plain_grid_put(&grid, 1, (struct vector){bodies[1].x_mm, bodies[1].y_mm});
    TEST_ASSERT_TRUE(is_hidden(2500.0, 1000.0));
    TEST_ASSERT_TRUE(is_hidden(3800.0, 2400.0));
    TEST_ASSERT_FALSE(is_hidden(1900.0, 1000.0));
}
