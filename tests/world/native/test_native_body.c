#include "host_sim/world/native/world.h"
#include "tests/test.h"
#include "tests/world/native/fake_space.h"

static struct world world;
static struct body *body;

void setUp(void)
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

TEST(the_left_wheel_turns_the_body_right)
{
    body_roll(body, 10.0, -10.0, 160.0);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, body->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(0.125, body->heading_rad);
}

TEST(an_arc_ends_to_the_right_of_where_it_began)
{
    body_roll(body, 40.0, 20.0, 160.0);
    TEST_ASSERT_TRUE(body->x_mm > 1029.0 && body->x_mm < 1030.0);
    TEST_ASSERT_TRUE(body->y_mm > 1001.0 && body->y_mm < 1002.0);
}

TEST(a_heading_stays_within_half_a_turn)
{
    body->heading_rad = 3.1;
    body_roll(body, 8.0, -8.0, 160.0);
    TEST_ASSERT_TRUE(body->heading_rad > -3.2 && body->heading_rad < -3.0);
}

TEST(a_body_is_pushed_out_to_a_hairs_breadth)
{
    body->depth_mm = 3.0;
    body->normal.x = fake.normal.x = 1.0;
    fake.depths[0] = 0.005;
    body_push_out(&world, body, (struct vector){990.0, 1000.0});
    TEST_ASSERT_EQUAL_size_t(1, fake.steps);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0 - (3.0 - 0.005), body->x_mm);
}

TEST(a_wedged_body_goes_back)
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

TEST(the_last_push_may_be_enough)
{
    body->depth_mm = 3.0;
    body->normal.x = fake.normal.x = 1.0;
    for (unsigned i = 0; i < 7; i++)
        fake.depths[i] = 3.0;
    body_push_out(&world, body, (struct vector){0.0, 0.0});
    TEST_ASSERT_EQUAL_size_t(8, fake.steps);
    TEST_ASSERT_TRUE(body->x_mm > 900.0);
}
