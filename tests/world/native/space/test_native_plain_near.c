#include "host_sim/world/native/space/plain_near.h"
#include "tests/test.h"

enum { BODIES = 3, CAPSULES = 3, CELLS = 2 };

static uint32_t heads[CELLS], nexts[BODIES], cells[BODIES], bodies_near[PLAIN_NEAR_MAX];
static struct plain_grid grid;
static struct plain_world space;
static struct body bodies[BODIES];
static struct world world;

/* Capsules 0 and 2 can be felt in the left cell, 1 in the right one. */
void setUp(void)
{
    static const uint32_t firsts[CELLS + 1] = {0, 2, 3}, numbers[CAPSULES] = {0, 2, 1};

    for (unsigned i = 0; i < CELLS; i++)
        heads[i] = 0;
    for (unsigned i = 0; i < BODIES; i++)
        nexts[i] = cells[i] = 0;
    grid = (struct plain_grid){500.0, CELLS, 1, firsts, numbers, heads, nexts, cells};
    space = (struct plain_world){.capsule_count = CAPSULES, .grid = &grid};
    world = (struct world){.space = &space.space, .body_count = BODIES, .bodies = bodies};
}

TEST(without_a_grid_everything_is_near)
{
    struct plain_choice near;

    space.grid = NULL;
    near = plain_near_capsules(&space, (struct vector){600.0, 10.0});
    TEST_ASSERT_EQUAL_size_t(CAPSULES, near.count);
    TEST_ASSERT_EQUAL_size_t(2, plain_chosen(&near, 2));
    TEST_ASSERT_EQUAL_size_t(BODIES, plain_near_bodies(&world, (struct vector){600.0, 10.0}, bodies_near));
    TEST_ASSERT_EQUAL_UINT32(2, bodies_near[2]);
}

TEST(a_cell_has_its_capsules)
{
    const struct plain_choice left = plain_near_capsules(&space, (struct vector){499.0, 10.0});
    const struct plain_choice right = plain_near_capsules(&space, (struct vector){501.0, 10.0});

    TEST_ASSERT_EQUAL_size_t(2, left.count);
    TEST_ASSERT_EQUAL_size_t(2, plain_chosen(&left, 1));
    TEST_ASSERT_EQUAL_size_t(1, right.count);
    TEST_ASSERT_EQUAL_size_t(1, plain_chosen(&right, 0));
}

TEST(bodies_are_those_in_the_cells_around)
{
    plain_grid_put(&grid, 1, (struct vector){10.0, 10.0});
    TEST_ASSERT_EQUAL_size_t(1, plain_near_bodies(&world, (struct vector){600.0, 10.0}, bodies_near));
    TEST_ASSERT_EQUAL_UINT32(1, bodies_near[0]);
}

TEST(a_body_is_where_its_middle_is)
{
    const struct body body = {.x_mm = 3.0, .y_mm = 4.0};

    TEST_ASSERT_EQUAL_DOUBLE(3.0, plain_position(&body).x);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, plain_position(&body).y);
}
