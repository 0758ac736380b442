#include "host_sim/world/native/world.h"

#include <unity.h>

#include "tests/world/fake_space.h"

static struct world world;
static struct body *body;

void setUp(void)
{
    fake_open(&world, 2, 2);
    body = &world.bodies[0];
}

void tearDown(void) {}

static void test_senses_are_those_of_the_body(void)
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

static void test_a_body_that_senses_nothing(void)
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

static void test_food_within_reach_is_eaten(void)
{
    world.food[0].eaten = true;
    TEST_ASSERT_EQUAL_size_t(1, world_food_left(&world));
    TEST_ASSERT_TRUE(eats_at(149.0));
    TEST_ASSERT_EQUAL_size_t(0, world_food_left(&world));
    TEST_ASSERT_FALSE(world_eat(&world, body));
}

static void test_food_out_of_reach_is_not_eaten(void)
{
    TEST_ASSERT_FALSE(eats_at(150.0));
    TEST_ASSERT_FALSE(eats_at(-100.0));
    TEST_ASSERT_FALSE(world.food[1].eaten);
}

static void test_wheels_roll_for_a_tick(void)
{
    world_move(&world, body, 200, 200);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, body->left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, body->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, fake.position.x);
}

static void test_wheels_have_a_fastest_speed_either_way(void)
{
    world_move(&world, body, 2000, -2000);
    TEST_ASSERT_EQUAL_DOUBLE(10.0, body->left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(-10.0, body->right_mm);
}

static void test_a_lifted_bodys_wheels_roll_in_the_air(void)
{
    body->lifted = true;
    world_move(&world, body, 200, 200);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, body->left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, body->x_mm);
    TEST_ASSERT_EQUAL_size_t(0, fake.steps);
}

static void test_a_body_that_runs_into_something_is_pushed_out(void)
{
    fake.depths[0] = 4.0;
    fake.normal.x = 1.0;
    world_move(&world, body, 200, 200);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0 - (4.0 - 0.005), body->x_mm);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_senses_are_those_of_the_body);
    RUN_TEST(test_a_body_that_senses_nothing);
    RUN_TEST(test_food_within_reach_is_eaten);
    RUN_TEST(test_food_out_of_reach_is_not_eaten);
    RUN_TEST(test_wheels_roll_for_a_tick);
    RUN_TEST(test_wheels_have_a_fastest_speed_either_way);
    RUN_TEST(test_a_lifted_bodys_wheels_roll_in_the_air);
    RUN_TEST(test_a_body_that_runs_into_something_is_pushed_out);
    return UNITY_END();
}
