#include "host_sim/world/native/space/plain_space.h"

#include <string.h>

#include "tests/test.h"

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
void setUp(void)
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

TEST(a_body_in_the_open_feels_nothing)
{
    put(body, 1500.0, 1000.0);
    TEST_ASSERT_EQUAL_HEX8(0, body->feel);
    TEST_ASSERT_EQUAL_INT32(0, body->touches);
}

TEST(a_bar_ahead_is_felt_and_then_touched)
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

TEST(a_collision_counts_when_it_begins)
{
    for (unsigned i = 0; i < 3; i++)
        put(body, 1885.0, 1000.0 + i);
    TEST_ASSERT_EQUAL_INT32(1, body->collisions);
    put(body, 1800.0, 1000.0);
    TEST_ASSERT_EQUAL_INT32(0, body->touches);
    put(body, 1885.0, 1000.0);
    TEST_ASSERT_EQUAL_INT32(2, body->collisions);
}

TEST(the_deepest_of_two_overlaps_counts)
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

TEST(a_lifted_body_neither_feels_nor_is_felt)
{
    put(&bodies[1], 1190.0, 1000.0);
    bodies[1].lifted = true;
    world_settle(&world);
    TEST_ASSERT_EQUAL_HEX8(0, body->feel);
    TEST_ASSERT_EQUAL_INT32(0, body->touches);
    TEST_ASSERT_EQUAL_INT32(0, bodies[1].touches);
}

TEST(an_obstacle_that_is_moved_is_felt_once_it_has_settled)
{
    capsule_set(&capsules[WALLS], (struct vector){1150.0, 500.0}, (struct vector){1150.0, 1500.0}, 20.0);
    plain_space_take(&space, &world);
    world_settle(&world);
    TEST_ASSERT_EQUAL_HEX8(FEEL_FRONT, body->feel & FEEL_FRONT);
}

TEST(what_a_body_touches_when_the_space_is_taken_is_not_new)
{
    put(body, 1885.0, 1000.0);
    plain_space_take(&space, &world);
    put(body, 1885.0, 1001.0);
    TEST_ASSERT_EQUAL_INT32(1, body->touches);
    TEST_ASSERT_EQUAL_INT32(1, body->collisions);
}
