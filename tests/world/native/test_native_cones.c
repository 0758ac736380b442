#include "host_sim/world/native/cones.h"
#include "tests/test.h"

static struct cones cones;

void setUp(void)
{
    cones_set(&cones, 160.0, 0.5);
}

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

TEST(each_cone_feels_what_is_in_its_direction)
{
    TEST_ASSERT_EQUAL_HEX(1, felt_at(0.0, 120.0));
    TEST_ASSERT_EQUAL_HEX(2, felt_at(85.0, 85.0));
    TEST_ASSERT_EQUAL_HEX(4, felt_at(120.0, 0.0));
    TEST_ASSERT_EQUAL_HEX(8, felt_at(85.0, -85.0));
    TEST_ASSERT_EQUAL_HEX(16, felt_at(0.0, -120.0));
}

TEST(nothing_is_felt_behind_the_body)
{
    TEST_ASSERT_EQUAL_HEX(0, felt_at(-120.0, 0.0));
    TEST_ASSERT_EQUAL_HEX(0, felt(-150.0, -300.0, -200.0, 300.0));
}

TEST(the_front_cone_reaches_a_little_farther)
{
    TEST_ASSERT_EQUAL_HEX(4, felt_at(180.2, 0.0));
    TEST_ASSERT_EQUAL_HEX(0, felt_at(180.9, 0.0));
    TEST_ASSERT_EQUAL_HEX(1, felt_at(0.0, 179.8));
    TEST_ASSERT_EQUAL_HEX(0, felt_at(0.0, 180.4));
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 160.5, cones.reach_mm);
}

TEST(a_wall_straight_ahead_is_in_the_three_front_cones)
{
    TEST_ASSERT_EQUAL_HEX(14, felt(150.0, -500.0, 150.0, 500.0));
    TEST_ASSERT_EQUAL_HEX(4, felt(180.2, -500.0, 180.2, 500.0));
    TEST_ASSERT_EQUAL_HEX(0, felt(181.0, -500.0, 181.0, 500.0));
}

TEST(an_end_that_pokes_in_between_the_corners_is_felt)
{
    TEST_ASSERT_EQUAL_HEX(4, felt(175.0, 17.0, 400.0, 17.0));
}

TEST(what_lies_right_through_a_cone_is_felt)
{
    const struct capsule thin = {.a = {100.0, -300.0}, .b = {100.0, 300.0}, .radius_mm = 0.001};
    const struct capsule inside = {.a = {100.0, 5.0}, .b = {110.0, 5.0}, .radius_mm = 0.001};

    TEST_ASSERT_EQUAL_HEX(2, felt_at(75.0, 85.0));
    TEST_ASSERT_TRUE(cones_overlap(&cones.of[2], &thin));
    TEST_ASSERT_FALSE(cones_overlap(&cones.of[0], &thin));
    TEST_ASSERT_TRUE(cones_overlap(&cones.of[2], &inside));
    TEST_ASSERT_FALSE(cones_overlap(&cones.of[1], &inside));
}
