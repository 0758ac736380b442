#include "tests/test.h"
#include "host_sim/world/native/space/plain_near.h"
#include "host_sim/world/native/space/plain_space.h"

#include <string.h>

enum { BODIES = 2, CAPSULES = WALLS + 1, WORDS = PLAIN_WORDS(CAPSULES + BODIES) };

static struct body bodies[BODIES];
static struct capsule capsules[CAPSULES];
static struct plain_place places[BODIES];
static uint64_t touching[(BODIES + 1) * WORDS];
static struct cones cones;
static struct plain_world space;
static struct world world;
static struct body *body;

/* Two bodies, far from each other, from the walls and from a bar at x = 2000. */
BEFORE_EACH(plain_space)
{
    static const struct world_params params = {160.0, 100.0, 150.0, 0.02, 500.0};

    memset(bodies, 0, sizeof bodies);
    memset(touching, 0, sizeof touching);
    for (unsigned i = 0; i < BODIES; i++)
        bodies[i] = (struct body){.x_mm = 1000.0, .y_mm = 1000.0 + 1000.0 * i, .seen = -1};
    capsule_set_walls(capsules, 4000.0, 3000.0);
    capsule_set(&capsules[WALLS], (struct vector){2000.0, 500.0}, (struct vector){2000.0, 1500.0}, 20.0);
    world = (struct world){.params = params, .body_count = BODIES, .bodies = bodies};
    space = (struct plain_world){.body_radius_mm = 100.0, .cones = &cones, .capsule_count = CAPSULES, .capsules = capsules, .places = places, .words = WORDS, .touching = touching};
    cones_set(&cones, 160.0, 0.5);
    world_begin(&world);
    plain_space_take(&space, &world);
    body = &bodies[0];
}

static void put(struct body *which, double x_mm, double y_mm)
{
    which->x_mm = x_mm;
    which->y_mm = y_mm;
    which->depth_mm = 0.0;
    world.space->place(&world, which);
}

TEST(body_in_the_open_triggers_no_sensor)
{
    put(body, 1500.0, 1000.0);
    TEST_ASSERT_EQUAL_HEX8(0, body->feel);
    TEST_ASSERT_EQUAL_INT32(0, body->touches);
}

TEST(bar_ahead_is_sensed_before_it_is_touched)
{
    put(body, 1850.0, 1000.0);
    TEST_ASSERT_EQUAL_HEX8(FEEL_FRONT_RIGHT | FEEL_FRONT | FEEL_FRONT_LEFT, body->feel);
    TEST_ASSERT_EQUAL_INT32(1, body->overlaps[2]);
    TEST_ASSERT_EQUAL_INT32(0, body->touches);
    put(body, 1885.0, 1000.0);
    TEST_ASSERT_EQUAL_INT32(1, body->touches);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, body->depth_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, body->normal.x);
}

TEST(collision_is_counted_at_its_start)
{
    for (unsigned i = 0; i < 3; i++)
        put(body, 1885.0, 1000.0 + i);
    TEST_ASSERT_EQUAL_INT32(1, body->collisions);
    put(body, 1800.0, 1000.0);
    TEST_ASSERT_EQUAL_INT32(0, body->touches);
    put(body, 1885.0, 1000.0);
    TEST_ASSERT_EQUAL_INT32(2, body->collisions);
}

TEST(body_takes_the_deeper_of_two_overlaps)
{
    put(body, 95.0, 98.0);
    TEST_ASSERT_EQUAL_INT32(2, body->touches);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, body->depth_mm);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, body->normal.x);
}

TEST(bodies_feel_and_touch_each_other)
{
    put(&bodies[1], 1230.0, 1000.0);
    TEST_ASSERT_EQUAL_HEX8(FEEL_FRONT, body->feel & FEEL_FRONT);
    TEST_ASSERT_EQUAL_HEX8(0, bodies[1].feel);
    put(&bodies[1], 1190.0, 1000.0);
    TEST_ASSERT_EQUAL_INT32(1, body->touches);
    TEST_ASSERT_EQUAL_INT32(1, bodies[1].touches);
    TEST_ASSERT_EQUAL_DOUBLE(10.0, body->depth_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, body->normal.x);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, bodies[1].normal.x);
    put(&bodies[1], 3000.0, 1000.0);
    TEST_ASSERT_EQUAL_HEX8(0, body->feel);
    TEST_ASSERT_EQUAL_INT32(0, body->touches);
    TEST_ASSERT_EQUAL_INT32(1, body->collisions);
}

TEST(lifted_body_neither_senses_nor_is_sensed)
{
    put(&bodies[1], 1190.0, 1000.0);
    bodies[1].lifted = true;
    world_settle(&world);
    TEST_ASSERT_EQUAL_HEX8(0, body->feel);
    TEST_ASSERT_EQUAL_INT32(0, body->touches);
    TEST_ASSERT_EQUAL_INT32(0, bodies[1].touches);
}

TEST(moved_obstacle_is_sensed_after_settling)
{
    capsule_set(&capsules[WALLS], (struct vector){1150.0, 500.0}, (struct vector){1150.0, 1500.0}, 20.0);
    plain_space_take(&space, &world);
    world_settle(&world);
    TEST_ASSERT_EQUAL_HEX8(FEEL_FRONT, body->feel & FEEL_FRONT);
}

TEST(contact_before_taking_the_space_is_not_counted_again)
{
    put(body, 1885.0, 1000.0);
    plain_space_take(&space, &world);
    put(body, 1885.0, 1001.0);
    TEST_ASSERT_EQUAL_INT32(1, body->touches);
    TEST_ASSERT_EQUAL_INT32(1, body->collisions);
}

enum { COLUMNS = 8 };

static struct capsule bar;

/* Two bodies, one below the other, and a bar at x = 2000. */
BEFORE_EACH(plain_view)
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

TEST(bar_hides_points_behind_it)
{
    TEST_ASSERT_TRUE(is_hidden(2500.0, 1000.0));
    TEST_ASSERT_FALSE(is_hidden(1900.0, 1000.0));
    TEST_ASSERT_FALSE(is_hidden(2500.0, 100.0));
}

TEST(other_body_hides_points_behind_it)
{
    TEST_ASSERT_TRUE(is_hidden(1000.0, 2500.0));
    TEST_ASSERT_FALSE(is_hidden(1000.0, 500.0));
}

TEST(lifted_body_hides_no_point)
{
    bodies[1].lifted = true;
    TEST_ASSERT_FALSE(is_hidden(1000.0, 2500.0));
}

TEST(body_does_not_hide_its_own_position)
{
    TEST_ASSERT_FALSE(is_hidden(1000.0, 1000.0));
}

TEST(view_searches_the_grid_cells_along_the_line)
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
