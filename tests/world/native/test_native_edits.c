#include "host_sim/world/native/edits.h"

#include <string.h>

#include "tests/test.h"
#include "tests/world/native/fake_space.h"

static struct furniture furniture;
static struct world world;

/* Two robots at (1000, 1000) and (1000, 2500) in an arena of 4 m by 3 m, one bar far away from them, and food. */
void setUp(void)
{
    static const struct bar far = {{500.0, 500.0}, {800.0, 500.0}};

    fake_open(&world, 2, 1);
    world.bodies[1].y_mm = 2500.0;
    furniture = (struct furniture){.width_mm = 4000.0, .height_mm = 3000.0, .bar_radius_mm = 20.0, .body_radius_mm = 100.0};
    furniture_set(&furniture, &far, 1);
}

static const char *edit(struct edit edit)
{
    return edit_make(&furniture, &world, &edit);
}

static const char *bar(enum edit_kind kind, uint32_t id, double ax, double ay, double bx, double by)
{
    return edit((struct edit){.kind = (int32_t)kind, .id = id, .a = {ax, ay}, .b = {bx, by}});
}

static const char *plant(enum edit_kind kind, uint32_t id, double x, double y, double radius)
{
    return edit((struct edit){.kind = (int32_t)kind, .id = id, .at = {x, y}, .radius = radius});
}

static const char *put(double x, double y)
{
    return edit((struct edit){.kind = EDIT_KIND_PUT, .at = {x, y}, .heading = -500.0});
}

static void lift(uint32_t robot)
{
    TEST_ASSERT_NULL(edit((struct edit){.kind = EDIT_KIND_LIFT, .robot = robot}));
}

TEST(bar_ids_increase_and_are_not_reused)
{
    TEST_ASSERT_NULL(bar(EDIT_KIND_ADD_BAR, 0, 3000.0, 100.0, 3000.0, 200.0));
    TEST_ASSERT_NULL(edit((struct edit){.kind = EDIT_KIND_REMOVE_BAR, .id = 0}));
    TEST_ASSERT_NULL(bar(EDIT_KIND_ADD_BAR, 0, 3500.0, 100.0, 3500.0, 200.0));
    TEST_ASSERT_EQUAL_size_t(2, furniture.bar_count);
    TEST_ASSERT_EQUAL_UINT32(1, furniture.bar_ids[0]);
    TEST_ASSERT_EQUAL_UINT32(2, furniture.bar_ids[1]);
    TEST_ASSERT_EQUAL_DOUBLE(3000.0, furniture.bars[0].a.x);
    TEST_ASSERT_EQUAL_size_t(WALLS + 2, furniture.capsule_count);
    TEST_ASSERT_EQUAL_DOUBLE(3500.0, furniture.capsules[WALLS + 1].a.x);
}

TEST(bar_is_moved_by_its_id)
{
    TEST_ASSERT_NULL(bar(EDIT_KIND_MOVE_BAR, 0, 3000.0, 100.0, 3000.0, 200.0));
    TEST_ASSERT_EQUAL_DOUBLE(200.0, furniture.bars[0].b.y);
    TEST_ASSERT_EQUAL_STRING("there is no such number", bar(EDIT_KIND_MOVE_BAR, 1, 3000.0, 100.0, 3000.0, 200.0));
    TEST_ASSERT_EQUAL_STRING("there is no such number", edit((struct edit){.kind = EDIT_KIND_REMOVE_BAR, .id = 1}));
}

TEST(pushed_bar_may_overlap_a_robot)
{
    TEST_ASSERT_EQUAL_STRING("the robot stands there", bar(EDIT_KIND_MOVE_BAR, 0, 1119.0, 900.0, 1119.0, 1100.0));
    TEST_ASSERT_EQUAL_DOUBLE(500.0, furniture.bars[0].a.x);
    TEST_ASSERT_NULL(bar(EDIT_KIND_PUSH_BAR, 0, 1119.0, 900.0, 1119.0, 1100.0));
    TEST_ASSERT_EQUAL_DOUBLE(1119.0, furniture.bars[0].a.x);
    TEST_ASSERT_EQUAL_STRING("that is outside of the arena", bar(EDIT_KIND_PUSH_BAR, 0, -1.0, 0.0, 100.0, 0.0));
    TEST_ASSERT_EQUAL_STRING("the obstacle is too short", bar(EDIT_KIND_PUSH_BAR, 0, 3000.0, 10.0, 3039.0, 10.0));
    TEST_ASSERT_EQUAL_STRING("there is no such number", bar(EDIT_KIND_PUSH_BAR, 1, 3000.0, 100.0, 3000.0, 200.0));
    TEST_ASSERT_EQUAL_DOUBLE(1119.0, furniture.bars[0].a.x);
}

TEST(bar_must_fit_the_arena_and_be_clear_of_robots)
{
    TEST_ASSERT_EQUAL_STRING("that is outside of the arena", bar(EDIT_KIND_ADD_BAR, 0, -1.0, 0.0, 100.0, 0.0));
    TEST_ASSERT_EQUAL_STRING("that is outside of the arena", bar(EDIT_KIND_ADD_BAR, 0, 100.0, 0.0, 100.0, 3001.0));
    TEST_ASSERT_EQUAL_STRING("the obstacle is too short", bar(EDIT_KIND_MOVE_BAR, 0, 3000.0, 10.0, 3039.0, 10.0));
    TEST_ASSERT_NULL(bar(EDIT_KIND_ADD_BAR, 0, 4000.0, 2960.0, 4000.0, 3000.0));
    TEST_ASSERT_EQUAL_STRING("the robot stands there", bar(EDIT_KIND_ADD_BAR, 0, 1119.0, 900.0, 1119.0, 1100.0));
    TEST_ASSERT_NULL(bar(EDIT_KIND_ADD_BAR, 0, 1121.0, 900.0, 1121.0, 1100.0));
    TEST_ASSERT_EQUAL_DOUBLE(500.0, furniture.bars[0].a.x);
}

TEST(bar_may_lie_under_a_lifted_robot)
{
    lift(0);
    TEST_ASSERT_NULL(bar(EDIT_KIND_ADD_BAR, 0, 900.0, 1000.0, 1100.0, 1000.0));
    TEST_ASSERT_EQUAL_STRING("the robot stands there", bar(EDIT_KIND_ADD_BAR, 0, 900.0, 2500.0, 1100.0, 2500.0));
}

TEST(bars_and_plants_are_limited_in_number)
{
    for (unsigned i = 1; i < EDIT_BARS_MAX; i++)
        TEST_ASSERT_NULL(bar(EDIT_KIND_ADD_BAR, 0, 3000.0, 100.0, 3000.0, 200.0));
    TEST_ASSERT_EQUAL_STRING("there are 40 obstacles already", bar(EDIT_KIND_ADD_BAR, 0, 3000.0, 100.0, 3000.0, 200.0));
    for (unsigned i = 0; i < FURNITURE_PLANTS_MAX; i++)
        TEST_ASSERT_NULL(plant(EDIT_KIND_PLANT, 0, 3000.0, 1000.0, 80.0));
    TEST_ASSERT_EQUAL_STRING("there are 20 plants already", plant(EDIT_KIND_PLANT, 0, 3000.0, 1000.0, 80.0));
    TEST_ASSERT_EQUAL_size_t(WALLS + EDIT_BARS_MAX + FURNITURE_PLANTS_MAX, furniture.capsule_count);
}

TEST(plants_can_be_moved_grown_and_removed)
{
    TEST_ASSERT_NULL(plant(EDIT_KIND_PLANT, 0, 3000.0, 1000.0, 80.0));
    TEST_ASSERT_NULL(plant(EDIT_KIND_PLANT, 0, 3500.0, 1000.0, 20.0));
    TEST_ASSERT_NULL(plant(EDIT_KIND_MOVE_PLANT, 0, 3000.0, 2000.0, 0.0));
    TEST_ASSERT_NULL(plant(EDIT_KIND_GROW_PLANT, 0, 0.0, 0.0, 500.0));
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, furniture.plants[0].at.y);
    TEST_ASSERT_EQUAL_DOUBLE(500.0, furniture.plants[0].radius_mm);
    TEST_ASSERT_NULL(plant(EDIT_KIND_REMOVE_PLANT, 0, 0.0, 0.0, 0.0));
    TEST_ASSERT_EQUAL_UINT32(1, furniture.plant_ids[0]);
    TEST_ASSERT_EQUAL_DOUBLE(3500.0, furniture.plants[0].at.x);
    TEST_ASSERT_EQUAL_STRING("there is no such number", plant(EDIT_KIND_REMOVE_PLANT, 0, 0.0, 0.0, 0.0));
    TEST_ASSERT_EQUAL_size_t(WALLS + 2, furniture.capsule_count);
}

TEST(plant_must_fit_the_arena_and_be_clear_of_robots)
{
    TEST_ASSERT_EQUAL_STRING("that is outside of the arena", plant(EDIT_KIND_PLANT, 0, 4001.0, 0.0, 80.0));
    TEST_ASSERT_EQUAL_STRING("a plant has a radius of 20 to 500 mm", plant(EDIT_KIND_PLANT, 0, 3000.0, 1000.0, 19.0));
    TEST_ASSERT_EQUAL_STRING("a plant has a radius of 20 to 500 mm", plant(EDIT_KIND_PLANT, 0, 3000.0, 1000.0, 501.0));
    TEST_ASSERT_EQUAL_STRING("the robot stands there", plant(EDIT_KIND_PLANT, 0, 1179.0, 1000.0, 80.0));
    TEST_ASSERT_NULL(plant(EDIT_KIND_PLANT, 0, 1181.0, 1000.0, 80.0));
    TEST_ASSERT_EQUAL_STRING("the robot stands there", plant(EDIT_KIND_GROW_PLANT, 0, 0.0, 0.0, 82.0));
    TEST_ASSERT_EQUAL_STRING("the robot stands there", plant(EDIT_KIND_MOVE_PLANT, 0, 1179.0, 1000.0, 0.0));
    TEST_ASSERT_EQUAL_DOUBLE(1181.0, furniture.plants[0].at.x);
}

TEST(food_is_moved_within_the_arena)
{
    TEST_ASSERT_NULL(edit((struct edit){.kind = EDIT_KIND_MOVE_FOOD, .at = {4000.0, 0.0}}));
    TEST_ASSERT_EQUAL_DOUBLE(4000.0, world.food[0].x_mm);
    TEST_ASSERT_EQUAL_STRING("that is outside of the arena",
                             edit((struct edit){.kind = EDIT_KIND_MOVE_FOOD, .at = {0.0, 3001.0}}));
    TEST_ASSERT_EQUAL_STRING("there is no such number", edit((struct edit){.kind = EDIT_KIND_MOVE_FOOD, .id = 1}));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, world.food[0].y_mm);
}

TEST(lifted_robot_is_put_down_only_where_there_is_room)
{
    TEST_ASSERT_EQUAL_STRING("the robot is not in the air", put(3000.0, 1000.0));
    lift(0);
    TEST_ASSERT_EQUAL_STRING("the robot is in the air already", edit((struct edit){.kind = EDIT_KIND_LIFT}));
    TEST_ASSERT_NULL(plant(EDIT_KIND_PLANT, 0, 3000.0, 2000.0, 80.0));
    TEST_ASSERT_EQUAL_STRING("there is no room for the robot", put(700.0, 500.0));
    TEST_ASSERT_EQUAL_STRING("there is no room for the robot", put(99.0, 1500.0));
    TEST_ASSERT_EQUAL_STRING("there is no room for the robot", put(3000.0, 2179.0));
    TEST_ASSERT_EQUAL_STRING("there is no room for the robot", put(1000.0, 2301.0));
    TEST_ASSERT_TRUE(world.bodies[0].lifted);
    TEST_ASSERT_NULL(put(1000.0, 2299.0));
    TEST_ASSERT_FALSE(world.bodies[0].lifted);
    TEST_ASSERT_EQUAL_DOUBLE(2299.0, world.bodies[0].y_mm);
    TEST_ASSERT_EQUAL_DOUBLE(-0.5, world.bodies[0].heading_rad);
}

TEST(lifted_robot_blocks_no_position)
{
    lift(0);
    lift(1);
    TEST_ASSERT_NULL(put(1000.0, 2500.0));
}

TEST(body_fault_is_set_for_one_robot)
{
    struct edit mirror = {.kind = EDIT_KIND_BODY, .robot = 1};

    strcpy(mirror.what, "mirror");
    TEST_ASSERT_NULL(edit(mirror));
    TEST_ASSERT_TRUE(world.bodies[1].faults.mirrored);
    TEST_ASSERT_FALSE(world.bodies[0].faults.mirrored);
    strcpy(mirror.what, "mirror:left");
    TEST_ASSERT_EQUAL_STRING("write mirror", edit(mirror));
    mirror.robot = 2;
    TEST_ASSERT_EQUAL_STRING("there is no such robot", edit(mirror));
}
