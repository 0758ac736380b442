#include "host_sim/world/native/cones.h"

#include <unity.h>

static struct cones cones;

void setUp(void)
{
    cones_set(&cones, 160.0, 0.5);
}

void tearDown(void) {}

/* The cones, as bits of feel, that a thing with ends at these places is in. */
static unsigned felt(double ax, double ay, double bx, double by)
{
    const struct capsule thing = {.a = {ax, ay}, .b = {bx, by}, .radius_mm = 20.0};
    unsigned bits = 0;

    for (unsigned n = 0; n < CONES; n++)
        bits |= (unsigned)cones_overlap(&cones.of[n], &thing) << n;
    return bits;
}

static unsigned felt_at(double x, double y)
{
    return felt(x, y, x, y);
}

static void test_each_cone_feels_what_is_in_its_direction(void)
{
    TEST_ASSERT_EQUAL_HEX(1, felt_at(0.0, 120.0));
    TEST_ASSERT_EQUAL_HEX(2, felt_at(85.0, 85.0));
    TEST_ASSERT_EQUAL_HEX(4, felt_at(120.0, 0.0));
    TEST_ASSERT_EQUAL_HEX(8, felt_at(85.0, -85.0));
    TEST_ASSERT_EQUAL_HEX(16, felt_at(0.0, -120.0));
}

static void test_nothing_is_felt_behind_the_body(void)
{
    TEST_ASSERT_EQUAL_HEX(0, felt_at(-120.0, 0.0));
    TEST_ASSERT_EQUAL_HEX(0, felt(-150.0, -300.0, -200.0, 300.0));
}

static void test_the_front_cone_reaches_a_little_farther(void)
{
    TEST_ASSERT_EQUAL_HEX(4, felt_at(180.2, 0.0));
    TEST_ASSERT_EQUAL_HEX(0, felt_at(180.9, 0.0));
    TEST_ASSERT_EQUAL_HEX(1, felt_at(0.0, 179.8));
    TEST_ASSERT_EQUAL_HEX(0, felt_at(0.0, 180.4));
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 160.5, cones.reach_mm);
}

static void test_a_wall_straight_ahead_is_in_the_three_front_cones(void)
{
    TEST_ASSERT_EQUAL_HEX(14, felt(150.0, -500.0, 150.0, 500.0));
    TEST_ASSERT_EQUAL_HEX(4, felt(180.2, -500.0, 180.2, 500.0));
    TEST_ASSERT_EQUAL_HEX(0, felt(181.0, -500.0, 181.0, 500.0));
}

static void test_an_end_that_pokes_in_between_the_corners_is_felt(void)
{
    TEST_ASSERT_EQUAL_HEX(4, felt(175.0, 17.0, 400.0, 17.0));
}

static void test_what_lies_right_through_a_cone_is_felt(void)
{
    const struct capsule thin = {.a = {100.0, -300.0}, .b = {100.0, 300.0}, .radius_mm = 0.001};
    const struct capsule inside = {.a = {100.0, 5.0}, .b = {110.0, 5.0}, .radius_mm = 0.001};

    TEST_ASSERT_EQUAL_HEX(2, felt_at(75.0, 85.0));
    TEST_ASSERT_TRUE(cones_overlap(&cones.of[2], &thin));
    TEST_ASSERT_FALSE(cones_overlap(&cones.of[0], &thin));
    TEST_ASSERT_TRUE(cones_overlap(&cones.of[2], &inside));
    TEST_ASSERT_FALSE(cones_overlap(&cones.of[1], &inside));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_cone_feels_what_is_in_its_direction);
    RUN_TEST(test_nothing_is_felt_behind_the_body);
    RUN_TEST(test_the_front_cone_reaches_a_little_farther);
    RUN_TEST(test_a_wall_straight_ahead_is_in_the_three_front_cones);
    RUN_TEST(test_an_end_that_pokes_in_between_the_corners_is_felt);
    RUN_TEST(test_what_lies_right_through_a_cone_is_felt);
    return UNITY_END();
}
