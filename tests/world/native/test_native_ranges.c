#include "host_sim/world/native/ranges.h"
#include "tests/test.h"

static struct capsule things[2];
static struct body bodies[2];
static struct world world;
static struct ranges ranges;

void setUp(void)
{
    ranges = (struct ranges){.capsules = things, .body_radius_mm = 100.0, .reach_mm = 160.0, .front_extra_mm = 0.5};
    bodies[0] = (struct body){.x_mm = 1000.0, .y_mm = 1000.0};
    bodies[1] = (struct body){.x_mm = 3000.0, .y_mm = 1000.0};
    world = (struct world){.body_count = 2, .bodies = bodies};
}

/* Adds a bar 40 mm thick. */
static void put(double ax, double ay, double bx, double by)
{
    capsule_set(&things[ranges.capsule_count++], (struct vector){ax, ay}, (struct vector){bx, by}, 20.0);
}

static void assert_ranges(uint8_t right, uint8_t front_right, uint8_t front, uint8_t front_left, uint8_t left)
{
    const uint8_t expected[FEEL_COUNT] = {right, front_right, front, front_left, left};
    uint8_t range_mm[FEEL_COUNT];

    ranges_measure(&ranges, &world, &bodies[0], range_mm);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, range_mm, FEEL_COUNT);
}

TEST(in_the_open_nothing_is_measured)
{
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}

TEST(a_bar_ahead_is_farther_away_in_the_cones_beside)
{
    put(1150.0, 500.0, 1150.0, 1500.0);
    assert_ranges(RANGE_NONE, 41, 30, 41, RANGE_NONE);
}

TEST(the_end_of_a_bar_is_measured_in_its_direction)
{
    put(1000.0, 1135.4, 1000.0, 1500.0);
    assert_ranges(15, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}

TEST(the_nearest_of_two_things_counts)
{
    put(1000.0, 870.0, 1000.0, 500.0);
    put(1000.0, 850.0, 1000.0, 500.0);
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, 10);
}

TEST(what_the_body_is_pressed_into_is_at_no_distance)
{
    put(1119.9, 1000.0, 1500.0, 1000.0);
    assert_ranges(RANGE_NONE, RANGE_NONE, 0, RANGE_NONE, RANGE_NONE);
}

TEST(the_front_cone_reaches_farther)
{
    put(1180.4, 1000.0, 1500.0, 1000.0);
    assert_ranges(RANGE_NONE, RANGE_NONE, 60, RANGE_NONE, RANGE_NONE);
    bodies[0].x_mm -= 0.2;
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}

TEST(what_is_behind_is_not_measured)
{
    put(870.0, 1000.0, 500.0, 1000.0);
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}

TEST(another_body_is_measured_unless_one_of_them_is_in_the_air)
{
    bodies[1].x_mm = 1225.0;
    assert_ranges(RANGE_NONE, 57, 25, 57, RANGE_NONE);
    bodies[1].lifted = true;
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
    bodies[1].lifted = false;
    bodies[0].lifted = true;
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}
