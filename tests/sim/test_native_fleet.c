#include "host_sim/sim/native/fleet.h"

#include <stdlib.h>
#include <string.h>

#include "tests/test.h"
#include "host_sim/world/native/space/plain_space.h"

enum { ROBOTS = 2, WORDS = PLAIN_WORDS(WALLS + ROBOTS), TICKS = 50 };

static struct body bodies[ROBOTS];
static struct food food[1];
static struct capsule walls[WALLS];
static struct plain_place places[ROBOTS];
static uint64_t touching[(ROBOTS + 1) * WORDS];
static struct cones cones;
static struct plain_world space;
static struct world world;
static struct fleet_robot robots[ROBOTS];
static uint32_t answer;

/* Two robots far from each other, and food that neither sees. */
void setUp(void)
{
    static const struct world_params params = {160.0, 100.0, 150.0, 0.02, 500.0};

    memset(robots, 0, sizeof robots);
    memset(touching, 0, sizeof touching);
    food[0] = (struct food){2000.0, 100.0, false};
    capsule_set_walls(walls, 4000.0, 3000.0);
    cones_set(&cones, 160.0, 0.5);
    world = (struct world){.params = params, .body_count = ROBOTS, .bodies = bodies, .food_count = 1, .food = food};
    space = (struct plain_world){.body_radius_mm = 100.0, .cones = &cones, .capsule_count = WALLS, .capsules = walls,
        .places = places, .words = WORDS, .touching = touching};
    for (unsigned i = 0; i < ROBOTS; i++) {
        bodies[i] = (struct body){.x_mm = 1000.0 + 2000.0 * i, .y_mm = 1500.0, .seen = -1};
        robots[i] = (struct fleet_robot){.core = malloc(fleet_core_size()), .world = &world, .body = &bodies[i],
            .ticks_max = TICKS};
        fleet_wake(&robots[i]);
        TEST_ASSERT_EQUAL_INT(RESULT_DONE, fleet_command(&robots[i], OPCODE_START, PROFILE_ARTICLE, 7 + i, &answer));
    }
    world_begin(&world);
    plain_space_take(&space, &world);
}

void tearDown(void)
{
    for (unsigned i = 0; i < ROBOTS; i++)
        free(robots[i].core);
}

TEST(fleet_runs_a_robot_for_the_given_ticks)
{
    TEST_ASSERT_EQUAL_size_t(1, fleet_run_alone(robots, 1, 20));
    TEST_ASSERT_EQUAL_UINT32(20, robots[0].tick);
    TEST_ASSERT_EQUAL_UINT32(0, robots[1].tick);
    TEST_ASSERT_TRUE(bodies[0].x_mm > 1000.0);
    TEST_ASSERT_GREATER_THAN_UINT32(0, robots[0].begun[REASON_WANDER]);
}

TEST(fleet_robot_hears_its_peers_once_a_second)
{
    static const uint8_t company[ROBOTS][CELL_COUNT] = {{0, 2, 0, 0, 2, 0, 0, 0}, {0, 1, 0, 1, 2, 0, 2, 0}};
    uint8_t known[CELL_COUNT];

    TEST_ASSERT_EQUAL_INT(RESULT_DONE, fleet_command(&robots[0], OPCODE_SET, SHARE, 1, &answer));
    robots[0].company = company[0];
    robots[0].company_size = ROBOTS;
    robots[0].ticks_max = 3 * TICKS;
    (void)fleet_run_alone(robots, 1, TICKS);
    fleet_memories(robots, 1, known);
    TEST_ASSERT_EACH_EQUAL_UINT8(0, known, CELL_COUNT);   /* what it hears in its second before SET does not count */
    (void)fleet_run_alone(robots, 1, TICKS);
    fleet_memories(robots, 1, known);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(company[1], known, CELL_COUNT);
    TEST_ASSERT_EQUAL_UINT32(2 * TICKS, robots[0].known_ticks);
}

TEST(memory_full_at_start_is_known_after_one_tick)
{
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, fleet_command(&robots[0], OPCODE_START, PROFILE_FIXED, 7, &answer));
    (void)fleet_run_alone(robots, 2, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].known_ticks);
    TEST_ASSERT_EQUAL_UINT32(0, robots[1].known_ticks);
}

TEST(run_ends_at_its_tick_limit)
{
    TEST_ASSERT_EQUAL_size_t(0, fleet_run_alone(robots, 1, TICKS + 1));
    TEST_ASSERT_EQUAL_UINT32(TICKS, robots[0].ticks);
}

TEST(run_ends_when_all_food_is_eaten)
{
    food[0] = (struct food){1200.0, 1500.0, false};
    TEST_ASSERT_EQUAL_size_t(0, fleet_run_alone(robots, 1, TICKS));
    TEST_ASSERT_TRUE(food[0].eaten);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].food_eaten);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_EAT]);
    TEST_ASSERT_TRUE(robots[0].ticks < TICKS);
}

TEST(robots_of_a_world_run_together)
{
    TEST_ASSERT_EQUAL_size_t(ROBOTS, fleet_run_together(robots, ROBOTS, 20));
    TEST_ASSERT_EQUAL_UINT32(20, robots[0].tick);
    TEST_ASSERT_EQUAL_UINT32(20, robots[1].tick);
    TEST_ASSERT_EQUAL_size_t(0, fleet_run_together(robots, ROBOTS, TICKS));
    TEST_ASSERT_EQUAL_UINT32(TICKS, robots[1].ticks);
}

TEST(command_returns_the_result_of_the_core)
{
    TEST_ASSERT_EQUAL_INT(RESULT_UNKNOWN_PROFILE, fleet_command(robots, OPCODE_START, 200, 1, &answer));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, fleet_command(robots, OPCODE_START, PROFILE_DISTANCE, 1, &answer));
    TEST_ASSERT_EQUAL_UINT32(ANSWER_WANTS_RANGES, answer);
}

TEST(fleet_returns_the_memory_of_the_core)
{
    uint8_t cells[CELL_COUNT];

    TEST_ASSERT_EQUAL_INT(RESULT_DONE, fleet_command(robots, OPCODE_START, PROFILE_FIXED, 1, &answer));
    fleet_memories(robots, 1, cells);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0, 1, 1, 1, 2, 1, 2, 1}), cells, CELL_COUNT);
}

TEST(patterns_are_recorded_in_order_of_first_encounter)
{
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, fleet_command(&robots[0], OPCODE_START, PROFILE_NEVER, 7, &answer));
    (void)fleet_run_alone(robots, 1, TICKS);
    TEST_ASSERT_EQUAL_HEX32(0, robots[0].met);
    for (unsigned sensors = 1, i = 0; i < 4; sensors = sensors == 4 ? 1 : 2 * sensors, i++) {
        bodies[0].faults = (struct body_faults){.stuck_on = (uint8_t)(sensors << 1)};
        robots[0].ticks = 0;
        (void)fleet_run_alone(robots, 1, TICKS);
    }
    TEST_ASSERT_EQUAL_HEX32(0x421, robots[0].met);
}
