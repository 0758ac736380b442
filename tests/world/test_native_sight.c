#include "host_sim/world/native/sight.h"

#include <unity.h>

#include "tests/world/fake_space.h"

static struct world world;
static struct body *body;

void setUp(void)
{
    fake_open(&world, 1, 2);
    body = &world.bodies[0];
    world.food[0].eaten = world.food[1].eaten = true;
}

void tearDown(void) {}

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

static void test_food_straight_ahead_is_seen(void)
{
    put(1, 300.0, 0.0);
    assert_sees(1, 300);
}

static void test_food_at_the_corridors_edge_is_seen_and_beyond_it_is_not(void)
{
    put(0, 300.0, 50.0);
    assert_sees(0, 304);
    put(0, 300.0, -50.1);
    assert_sees(-1, 0);
}

static void test_food_beside_and_behind_is_not_seen(void)
{
    put(0, 0.0, 10.0);
    put(1, -300.0, 0.0);
    assert_sees(-1, 0);
}

static void test_the_nearest_food_is_seen(void)
{
    put(0, 300.0, 0.0);
    put(1, 200.0, 0.0);
    assert_sees(1, 200);
}

static void test_of_two_equally_far_the_first_is_seen(void)
{
    put(0, 300.0, 10.0);
    put(1, 300.0, -10.0);
    assert_sees(0, 300);
}

static void test_eaten_food_is_not_seen(void)
{
    put(0, 300.0, 0.0);
    world.food[0].eaten = true;
    assert_sees(-1, 0);
}

static void test_hidden_food_is_not_seen(void)
{
    put(0, 300.0, 0.0);
    fake.hides = true;
    assert_sees(-1, 0);
}

static void test_food_under_the_body_is_a_millimetre_away(void)
{
    put(0, 0.2, 0.0);
    assert_sees(0, 1);
}

static void test_halves_are_rounded_to_even(void)
{
    put(0, 300.5, 0.0);
    assert_sees(0, 300);
    put(0, 301.5, 0.0);
    assert_sees(0, 302);
}

static void test_a_body_in_the_air_sees_nothing(void)
{
    put(0, 300.0, 0.0);
    body->lifted = true;
    assert_sees(-1, 0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_food_straight_ahead_is_seen);
    RUN_TEST(test_food_at_the_corridors_edge_is_seen_and_beyond_it_is_not);
    RUN_TEST(test_food_beside_and_behind_is_not_seen);
    RUN_TEST(test_the_nearest_food_is_seen);
    RUN_TEST(test_of_two_equally_far_the_first_is_seen);
    RUN_TEST(test_eaten_food_is_not_seen);
    RUN_TEST(test_hidden_food_is_not_seen);
    RUN_TEST(test_food_under_the_body_is_a_millimetre_away);
    RUN_TEST(test_halves_are_rounded_to_even);
    RUN_TEST(test_a_body_in_the_air_sees_nothing);
    return UNITY_END();
}
