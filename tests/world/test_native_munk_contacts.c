#include <unity.h>

#include "tests/world/fake_munk.h"

enum { OBSTACLE = 1, DISC = 2, FRONT = 2, FRONT_CONE = 100 + FRONT };

static struct world world;

void setUp(void)
{
    fake_open(&world, 2, 0);
}

void tearDown(void) {}

static void begin(uintptr_t type_a, uintptr_t type_b)
{
    struct munk_handler *handler = fake_handler(type_a, type_b);

    handler->begin(NULL, NULL, handler->data);
}

static void press(uintptr_t type_a, uintptr_t type_b)
{
    struct munk_handler *handler = fake_handler(type_a, type_b);

    handler->pre_solve(NULL, NULL, handler->data);
}

static void separate(uintptr_t type_a, uintptr_t type_b)
{
    struct munk_handler *handler = fake_handler(type_a, type_b);

    handler->separate(NULL, NULL, handler->data);
}

static void overlap(double depth_mm, double normal_x)
{
    fake.contacts.points[0].distance = -depth_mm;
    fake.contacts.normal.x = normal_x;
}

static void test_a_cone_feels_an_obstacle(void)
{
    begin(FRONT_CONE, OBSTACLE);
    TEST_ASSERT_EQUAL_HEX8(FEEL_FRONT, world.bodies[0].feel);
    TEST_ASSERT_EQUAL_HEX8(0, world.bodies[1].feel);
}

static void test_each_cone_of_each_body_has_its_bit(void)
{
    for (unsigned body = 0; body < 2; body++)
        for (unsigned n = 0; n < WORLD_CONES; n++) {
            begin(100 + body * WORLD_CONES + n, DISC);
            TEST_ASSERT_BITS_HIGH(1u << n, world.bodies[body].feel);
            separate(100 + body * WORLD_CONES + n, DISC);
            TEST_ASSERT_EQUAL_HEX8(0, world.bodies[body].feel);
        }
}

static void test_a_cone_feels_until_the_last_thing_has_left_it(void)
{
    begin(FRONT_CONE, OBSTACLE);
    begin(FRONT_CONE, DISC);
    press(FRONT_CONE, OBSTACLE);
    separate(FRONT_CONE, OBSTACLE);
    TEST_ASSERT_EQUAL_HEX8(FEEL_FRONT, world.bodies[0].feel);
    separate(FRONT_CONE, DISC);
    TEST_ASSERT_EQUAL_HEX8(0, world.bodies[0].feel);
}

static void test_a_body_counts_what_it_touches(void)
{
    fake.shapes[0] = fake_disc(1);
    begin(DISC, OBSTACLE);
    begin(DISC, OBSTACLE);
    separate(DISC, OBSTACLE);
    TEST_ASSERT_EQUAL_INT32(1, world.bodies[1].touches);
    TEST_ASSERT_EQUAL_INT32(2, world.bodies[1].collisions);
    TEST_ASSERT_EQUAL_INT32(0, world.bodies[0].touches);
}

static void test_two_bodies_touch_each_other(void)
{
    fake.shapes[0] = fake_disc(0);
    fake.shapes[1] = fake_disc(1);
    begin(DISC, DISC);
    TEST_ASSERT_EQUAL_INT32(1, world.bodies[0].touches);
    TEST_ASSERT_EQUAL_INT32(1, world.bodies[1].touches);
    separate(DISC, DISC);
    TEST_ASSERT_EQUAL_INT32(0, world.bodies[0].touches);
    TEST_ASSERT_EQUAL_INT32(0, world.bodies[1].touches);
}

static void test_the_deepest_overlap_counts(void)
{
    fake.shapes[0] = fake_disc(0);
    overlap(2.0, 1.0);
    press(DISC, OBSTACLE);
    overlap(1.0, -1.0);
    press(DISC, OBSTACLE);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, world.bodies[0].depth_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, world.bodies[0].normal.x);
}

static void test_the_normal_points_out_of_each_body(void)
{
    fake.shapes[0] = fake_disc(0);
    fake.shapes[1] = fake_disc(1);
    overlap(2.0, 1.0);
    press(DISC, DISC);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, world.bodies[0].normal.x);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, world.bodies[1].normal.x);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_cone_feels_an_obstacle);
    RUN_TEST(test_each_cone_of_each_body_has_its_bit);
    RUN_TEST(test_a_cone_feels_until_the_last_thing_has_left_it);
    RUN_TEST(test_a_body_counts_what_it_touches);
    RUN_TEST(test_two_bodies_touch_each_other);
    RUN_TEST(test_the_deepest_overlap_counts);
    RUN_TEST(test_the_normal_points_out_of_each_body);
    return UNITY_END();
}
