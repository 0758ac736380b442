#include "host_sim/world/native/world.h"
#include "tests/test.h"
#include "tests/world/native/fake_space.h"

static struct world world;
static struct body *body;

void setUp(void)
{
    fake_open(&world, 2, 2);
    body = &world.bodies[0];
}

TEST(senses_are_those_of_the_body)
{
    struct senses senses;

    body->feel = FEEL_LEFT;
    body->touches = 2;
    body->left_mm = 12.34;
    body->right_mm = -0.1;
    world.food[1] = (struct food){1200.0, 1000.0, false};
    world_sense(&world, body, TICK_SPAN - 5, &senses);
    TEST_ASSERT_EQUAL_UINT16(TICK_SPAN - 5, senses.tick);
    TEST_ASSERT_EQUAL_HEX8(FEEL_LEFT, senses.feel);
    TEST_ASSERT_TRUE(senses.bump && senses.look);
    TEST_ASSERT_EQUAL_UINT16(200, senses.beacon_mm);
    TEST_ASSERT_EQUAL_UINT16(123, senses.odometer_left);
    TEST_ASSERT_EQUAL_UINT16(ODOMETER_SPAN - 1, senses.odometer_right);
}

TEST(a_body_that_senses_nothing)
{
    struct senses senses;

    world_sense(&world, body, 0, &senses);
    TEST_ASSERT_FALSE(senses.bump || senses.look);
    TEST_ASSERT_EQUAL_UINT16(0, senses.beacon_mm);
}

static bool eats_at(double ahead_mm)
{
    struct senses senses;

    world.food[1] = (struct food){1000.0 + ahead_mm, 1000.0, false};
    world_sense(&world, body, 0, &senses);
    return world_eat(&world, body);
}

TEST(food_within_reach_is_eaten)
{
    world.food[0].eaten = true;
    TEST_ASSERT_EQUAL_size_t(1, world_food_left(&world));
    TEST_ASSERT_TRUE(eats_at(149.0));
    TEST_ASSERT_EQUAL_size_t(0, world_food_left(&world));
    TEST_ASSERT_FALSE(world_eat(&world, body));
}

TEST(food_out_of_reach_is_not_eaten)
{
    TEST_ASSERT_FALSE(eats_at(150.0));
    TEST_ASSERT_FALSE(eats_at(-100.0));
    TEST_ASSERT_FALSE(world.food[1].eaten);
}

TEST(wheels_roll_for_a_tick)
{
    world_move(&world, body, 200, 200);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, body->left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, body->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, fake.position.x);
}

TEST(wheels_have_a_fastest_speed_either_way)
{
    world_move(&world, body, 2000, -2000);
    TEST_ASSERT_EQUAL_DOUBLE(10.0, body->left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(-10.0, body->right_mm);
}

TEST(a_lifted_bodys_wheels_roll_in_the_air)
{
    body->lifted = true;
    world_move(&world, body, 200, 200);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, body->left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, body->x_mm);
    TEST_ASSERT_EQUAL_size_t(0, fake.steps);
}

TEST(a_body_that_runs_into_something_is_pushed_out)
{
    fake.depths[0] = 4.0;
    fake.normal.x = 1.0;
    world_move(&world, body, 200, 200);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0 - (4.0 - 0.005), body->x_mm);
}
