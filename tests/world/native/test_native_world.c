#include "tests/test.h"
#include "host_sim/world/native/world.h"
#include "tests/world/native/fake_space.h"

static struct world world;
static struct body *body;

BEFORE_EACH(world)
{
    fake_open(&world, 2, 2);
    body = &world.bodies[0];
}

TEST(world_sense_reads_the_state_of_the_body)
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

TEST(body_in_the_open_senses_nothing)
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

TEST(world_eat_takes_food_within_reach)
{
    world.food[0].eaten = true;
    TEST_ASSERT_EQUAL_size_t(1, world_food_left(&world));
    TEST_ASSERT_TRUE(eats_at(149.0));
    TEST_ASSERT_EQUAL_size_t(0, world_food_left(&world));
    TEST_ASSERT_FALSE(world_eat(&world, body));
}

TEST(world_eat_leaves_food_out_of_reach)
{
    TEST_ASSERT_FALSE(eats_at(150.0));
    TEST_ASSERT_FALSE(eats_at(-100.0));
    TEST_ASSERT_FALSE(world.food[1].eaten);
}

TEST(world_move_rolls_the_wheels_for_a_tick)
{
    world_move(&world, body, 200, 200);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, body->left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, body->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, fake.position.x);
}

TEST(wheel_speed_is_limited_in_both_directions)
{
    world_move(&world, body, 2000, -2000);
    TEST_ASSERT_EQUAL_DOUBLE(10.0, body->left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(-10.0, body->right_mm);
}

TEST(wheels_of_a_lifted_body_roll_without_moving_it)
{
    body->lifted = true;
    world_move(&world, body, 200, 200);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, body->left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, body->x_mm);
    TEST_ASSERT_EQUAL_size_t(0, fake.steps);
}

TEST(colliding_body_is_pushed_out)
{
    fake.depths[0] = 4.0;
    fake.normal.x = 1.0;
    world_move(&world, body, 200, 200);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0 - (4.0 - 0.005), body->x_mm);
}

BEFORE_EACH(body)
{
    fake_open(&world, 1, 0);
    body = &world.bodies[0];
}

TEST(equal_wheels_roll_straight_on)
{
    body_roll(body, 10.0, 10.0, 160.0);
    TEST_ASSERT_EQUAL_DOUBLE(1010.0, body->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, body->y_mm);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, body->heading_rad);
}

TEST(left_wheel_forward_turns_the_body_right)
{
    body_roll(body, 10.0, -10.0, 160.0);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, body->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(0.125, body->heading_rad);
}

TEST(arc_with_faster_left_wheel_ends_to_the_right)
{
    body_roll(body, 40.0, 20.0, 160.0);
    TEST_ASSERT_TRUE(body->x_mm > 1029.0 && body->x_mm < 1030.0);
    TEST_ASSERT_TRUE(body->y_mm > 1001.0 && body->y_mm < 1002.0);
}

TEST(heading_wraps_at_half_a_turn)
{
    body->heading_rad = 3.1;
    body_roll(body, 8.0, -8.0, 160.0);
    TEST_ASSERT_TRUE(body->heading_rad > -3.2 && body->heading_rad < -3.0);
}

TEST(push_out_leaves_an_overlap_of_5_micrometres)
{
    body->depth_mm = 3.0;
    body->normal.x = fake.normal.x = 1.0;
    fake.depths[0] = 0.005;
    body_push_out(&world, body, (struct vector){990.0, 1000.0});
    TEST_ASSERT_EQUAL_size_t(1, fake.steps);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0 - (3.0 - 0.005), body->x_mm);
}

TEST(body_that_cannot_be_pushed_out_returns_to_its_place)
{
    body->depth_mm = 3.0;
    body->normal.x = fake.normal.x = 1.0;
    for (unsigned i = 0; i < 8; i++)
        fake.depths[i] = 3.0;
    body_push_out(&world, body, (struct vector){990.0, 980.0});
    TEST_ASSERT_EQUAL_size_t(9, fake.steps);
    TEST_ASSERT_EQUAL_DOUBLE(990.0, body->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(980.0, body->y_mm);
    TEST_ASSERT_EQUAL_DOUBLE(990.0, fake.position.x);
}

TEST(body_is_free_after_the_last_push)
{
    body->depth_mm = 3.0;
    body->normal.x = fake.normal.x = 1.0;
    for (unsigned i = 0; i < 7; i++)
        fake.depths[i] = 3.0;
    body_push_out(&world, body, (struct vector){0.0, 0.0});
    TEST_ASSERT_EQUAL_size_t(8, fake.steps);
    TEST_ASSERT_TRUE(body->x_mm > 900.0);
}

BEFORE_EACH(sight)
{
    fake_open(&world, 1, 2);
    body = &world.bodies[0];
    world.food[0].eaten = world.food[1].eaten = true;
}

static void put(size_t number, double ahead_mm, double right_mm)
{
    world.food[number] = (struct food){1000.0 + ahead_mm, 1000.0 + right_mm, false};
}

static void assert_sees(int32_t number, int32_t distance_mm)
{
    sight_look(&world, body);
    TEST_ASSERT_EQUAL_INT32(number, body->seen);
    TEST_ASSERT_EQUAL_INT32(distance_mm, body->seen_mm);
}

TEST(food_straight_ahead_is_seen)
{
    put(1, 300.0, 0.0);
    assert_sees(1, 300);
}

TEST(food_is_seen_up_to_the_edge_of_the_beam)
{
    put(0, 300.0, 50.0);
    assert_sees(0, 304);
    put(0, 300.0, -50.1);
    assert_sees(-1, 0);
}

TEST(food_beside_and_behind_is_not_seen)
{
    put(0, 0.0, 10.0);
    put(1, -300.0, 0.0);
    assert_sees(-1, 0);
}

TEST(nearest_food_is_seen)
{
    put(0, 300.0, 0.0);
    put(1, 200.0, 0.0);
    assert_sees(1, 200);
}

TEST(first_of_two_equally_distant_foods_is_seen)
{
    put(0, 300.0, 10.0);
    put(1, 300.0, -10.0);
    assert_sees(0, 300);
}

TEST(eaten_food_is_not_seen)
{
    put(0, 300.0, 0.0);
    world.food[0].eaten = true;
    assert_sees(-1, 0);
}

TEST(hidden_food_is_not_seen)
{
    put(0, 300.0, 0.0);
    fake.hides = true;
    assert_sees(-1, 0);
}

TEST(food_under_the_body_is_at_1_mm)
{
    put(0, 0.2, 0.0);
    assert_sees(0, 1);
}

TEST(distance_of_food_is_rounded_half_to_even)
{
    put(0, 300.5, 0.0);
    assert_sees(0, 300);
    put(0, 301.5, 0.0);
    assert_sees(0, 302);
}

TEST(lifted_body_sees_no_food)
{
    put(0, 300.0, 0.0);
    body->lifted = true;
    assert_sees(-1, 0);
}
