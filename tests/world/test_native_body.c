#include "host_sim/world/native/body.h"

#include <unity.h>

#include "tests/world/fake_space.h"

static struct world world;
static struct body *body;

void setUp(void)
{
    fake_open(&world, 1, 0);
    body = &world.bodies[0];
}

void tearDown(void) {}

static void test_equal_wheels_roll_straight_on(void)
{
    body_roll(body, 10.0, 10.0, 160.0);
    TEST_ASSERT_EQUAL_DOUBLE(1010.0, body->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, body->y_mm);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, body->heading_rad);
}

static void test_the_left_wheel_turns_the_body_right(void)
{
    body_roll(body, 10.0, -10.0, 160.0);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, body->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(0.125, body->heading_rad);
}

static void test_an_arc_ends_to_the_right_of_where_it_began(void)
{
    body_roll(body, 40.0, 20.0, 160.0);
    TEST_ASSERT_TRUE(body->x_mm > 1029.0 && body->x_mm < 1030.0);
    TEST_ASSERT_TRUE(body->y_mm > 1001.0 && body->y_mm < 1002.0);
}

static void test_a_heading_stays_within_half_a_turn(void)
{
    body->heading_rad = 3.1;
    body_roll(body, 8.0, -8.0, 160.0);
    TEST_ASSERT_TRUE(body->heading_rad > -3.2 && body->heading_rad < -3.0);
}

static void test_a_body_is_pushed_out_to_a_hairs_breadth(void)
{
    body->depth_mm = 3.0;
    body->normal.x = fake.normal.x = 1.0;
    fake.depths[0] = 0.005;
    body_push_out(&world, body, (struct vector){990.0, 1000.0});
    TEST_ASSERT_EQUAL_size_t(1, fake.steps);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0 - (3.0 - 0.005), body->x_mm);
}

static void test_a_wedged_body_goes_back(void)
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

static void test_the_last_push_may_be_enough(void)
{
    body->depth_mm = 3.0;
    body->normal.x = fake.normal.x = 1.0;
    for (unsigned i = 0; i < 7; i++)
        fake.depths[i] = 3.0;
    body_push_out(&world, body, (struct vector){0.0, 0.0});
    TEST_ASSERT_EQUAL_size_t(8, fake.steps);
    TEST_ASSERT_TRUE(body->x_mm > 900.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_equal_wheels_roll_straight_on);
    RUN_TEST(test_the_left_wheel_turns_the_body_right);
    RUN_TEST(test_an_arc_ends_to_the_right_of_where_it_began);
    RUN_TEST(test_a_heading_stays_within_half_a_turn);
    RUN_TEST(test_a_body_is_pushed_out_to_a_hairs_breadth);
    RUN_TEST(test_a_wedged_body_goes_back);
    RUN_TEST(test_the_last_push_may_be_enough);
    return UNITY_END();
}
