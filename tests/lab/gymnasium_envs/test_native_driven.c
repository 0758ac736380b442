#include "host_sim/lab/gymnasium_envs/native/driven.h"

#include <string.h>

#include "tests/test.h"
#include "firmware/motion/motion.h"
#include "host_sim/world/native/space/plain_space.h"

enum { BODIES = 2, WORDS = PLAIN_WORDS(WALLS + BODIES), ODOMETER = 5 };

static struct body bodies[BODIES];
static struct food food;
static struct cones cones;
static struct capsule capsules[WALLS];
static struct plain_place places[BODIES];
static uint64_t touching[(BODIES + 1) * WORDS];
static struct plain_world space;
static struct world world;
static struct motion motions[BODIES];
static struct driven_robot robots[BODIES];
static struct driven driven;

/* Two robots that look to the right, and food at 2000, 1000. */
void setUp(void)
{
    static const struct world_params params = {160.0, 100.0, 150.0, 0.02, 500.0};

    memset(bodies, 0, sizeof bodies);
    memset(touching, 0, sizeof touching);
    for (unsigned i = 0; i < BODIES; i++)
        bodies[i] = (struct body){.x_mm = 1000.0, .y_mm = 1000.0 + 1000.0 * i, .seen = -1};
    food = (struct food){2000.0, 1000.0, false};
    cones_set(&cones, 160.0, 0.5);
    capsule_set_walls(capsules, 4000.0, 3000.0);
    world = (struct world){.params = params, .body_count = BODIES, .bodies = bodies, .food_count = 1, .food = &food};
    space = (struct plain_world){.body_radius_mm = 100.0, .cones = &cones,
        .capsule_count = WALLS, .capsules = capsules, .places = places, .words = WORDS, .touching = touching};
    driven = (struct driven){.world = &world, .motions = motions, .robots = robots, .limit_ticks = 1000, .step_ticks = 1000};
}

static void begin(void)
{
    world_begin(&world);
    plain_space_take(&space, &world);
    driven_begin(&driven);
}

static void step(uint8_t first, uint8_t second)
{
    const uint8_t actions[BODIES] = {first, second};

    driven_step(&driven, 1, actions);
}

TEST(driven_robots_have_senses_before_the_first_step)
{
    begin();

    TEST_ASSERT_EQUAL_INT32(1, robots[0].senses[3]);
    TEST_ASSERT_EQUAL_INT32(1000, robots[0].senses[4]);
    TEST_ASSERT_EQUAL_INT32(0, robots[1].senses[3]);
    TEST_ASSERT_EQUAL_UINT32(1, driven.food_left);
}

TEST(robot_that_finishes_first_rests)
{
    begin();
    step(DRIVEN_FORWARD, DRIVEN_TURN_ABOUT);

    TEST_ASSERT_EQUAL_INT32(120, robots[0].senses[ODOMETER]);
    TEST_ASSERT_EQUAL_INT32(120, robots[0].senses[ODOMETER + 1]);
    TEST_ASSERT_INT32_WITHIN(8, 2513, robots[1].senses[ODOMETER]);
    TEST_ASSERT_GREATER_THAN_UINT32(40, driven.tick);
}

TEST(food_is_eaten_at_the_end_of_a_step_forward)
{
    bodies[0].x_mm = 1860.0;
    begin();
    step(DRIVEN_TURN_LEFT, DRIVEN_TURN_LEFT);
    TEST_ASSERT_EQUAL_UINT32(0, robots[0].food_eaten);
    step(DRIVEN_TURN_RIGHT, DRIVEN_TURN_RIGHT);
    step(DRIVEN_FORWARD, DRIVEN_FORWARD);

    TEST_ASSERT_EQUAL_UINT32(1, robots[0].food_eaten);
    TEST_ASSERT_EQUAL_UINT32(0, robots[1].food_eaten);
    TEST_ASSERT_EQUAL_UINT32(0, driven.food_left);
}

TEST(step_without_food_left_takes_no_tick)
{
    food.eaten = true;
    begin();
    step(DRIVEN_FORWARD, DRIVEN_FORWARD);

    TEST_ASSERT_EQUAL_UINT32(0, driven.tick);
}

TEST(step_ends_at_its_tick_limit)
{
    driven.step_ticks = 2;
    begin();
    step(DRIVEN_FORWARD, DRIVEN_TURN_ABOUT);

    TEST_ASSERT_EQUAL_UINT32(2, driven.tick);
}

TEST(step_ended_by_its_limit_eats)
{
    bodies[0].x_mm = 1860.0;
    driven.step_ticks = 1;
    begin();
    step(DRIVEN_FORWARD, DRIVEN_FORWARD);

    TEST_ASSERT_EQUAL_UINT32(1, robots[0].food_eaten);
}

TEST(step_beyond_the_time_limit_has_no_effect)
{
    bodies[0].x_mm = 1900.0;
    driven.limit_ticks = 3;
    begin();
    step(DRIVEN_TURN_LEFT, DRIVEN_TURN_ABOUT);
    TEST_ASSERT_EQUAL_UINT8(0, bodies[0].seen);
    step(DRIVEN_FORWARD, DRIVEN_FORWARD);

    TEST_ASSERT_EQUAL_UINT32(3, driven.tick);
    TEST_ASSERT_EQUAL_UINT32(0, robots[0].food_eaten);
}

TEST(collisions_are_counted_per_step)
{
    uint32_t bumps = 0;

    bodies[0].x_mm = 3880.0;
    begin();
    for (unsigned i = 0; i < 20; i++) {
        step(DRIVEN_FORWARD, DRIVEN_TURN_LEFT);
        bumps += robots[0].collisions;
    }

    TEST_ASSERT_EQUAL_UINT32((uint32_t)bodies[0].collisions, bumps);
    TEST_ASSERT_GREATER_THAN_UINT32(0, bumps);
}
