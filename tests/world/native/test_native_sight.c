#include "host_sim/world/native/world.h"
#include "tests/test.h"
#include "tests/world/native/fake_space.h"

static struct world world;
static struct body *body;

void setUp(void)
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

TEST(food_at_the_corridors_edge_is_seen_and_beyond_it_is_not)
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

TEST(the_nearest_food_is_seen)
{
    put(0, 300.0, 0.0);
    put(1, 200.0, 0.0);
    assert_sees(1, 200);
}

TEST(of_two_equally_far_the_first_is_seen)
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

TEST(food_under_the_body_is_a_millimetre_away)
{
    put(0, 0.2, 0.0);
    assert_sees(0, 1);
}

TEST(halves_are_rounded_to_even)
{
    put(0, 300.5, 0.0);
    assert_sees(0, 300);
    put(0, 301.5, 0.0);
    assert_sees(0, 302);
}

TEST(a_body_in_the_air_sees_nothing)
{
    put(0, 300.0, 0.0);
    body->lifted = true;
    assert_sees(-1, 0);
}
