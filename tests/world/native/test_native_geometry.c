/* Sine, cosine and distance: known answers, to the last bit. */
#include "tests/test.h"
#include "host_sim/world/native/draw/layout.h"
#include "host_sim/world/native/edits.h"
#include "host_sim/world/native/ranges.h"
#include "host_sim/world/native/trig.h"

#include <string.h>

static const double TURN_RAD = 6.283185307179586;

TEST(sine_and_cosine_match_reference_values)
{
    static const struct {
        double angle_rad, sin, cos;
    } known[] = {
        {0.0, 0.0, 1.0}, {0.5, 0.479425538604203, 0.8775825618903728}, {1.0, 0.8414709848078965, 0.5403023058681398},
        {2.0, 0.9092974268256817, -0.4161468365471424}, {-3.0, -0.1411200080598672, -0.9899924966004454},
        {100.0, -0.5063656411097588, 0.8623188722876839}, {1e6, -0.34999350217129294, 0.9367521275331447},
    };

    for (unsigned i = 0; i < sizeof known / sizeof *known; i++) {
        TEST_ASSERT_DOUBLE_WITHIN(2.3e-16, known[i].sin, trig_sin(known[i].angle_rad));
        TEST_ASSERT_DOUBLE_WITHIN(2.3e-16, known[i].cos, trig_cos(known[i].angle_rad));
    }
}

TEST(sine_and_cosine_lie_on_the_unit_circle)
{
    for (int i = -1000; i <= 1000; i++) {
        double angle_rad = i * TURN_RAD / 360.0;
        double sin = trig_sin(angle_rad), cos = trig_cos(angle_rad);

        TEST_ASSERT_DOUBLE_WITHIN(1e-15, 1.0, sin * sin + cos * cos);
        TEST_ASSERT_TRUE(trig_sin(-angle_rad) == -sin);
        TEST_ASSERT_TRUE(trig_cos(-angle_rad) == cos);
    }
}

static uint64_t digest_with(uint64_t digest, double value)
{
    uint64_t bits;

    memcpy(&bits, &value, sizeof bits);
    return (digest ^ bits) * 1099511628211u;
}

/* This number was computed with gcc and glibc on x86-64; every compiler, library and processor has to give it. */
TEST(trigonometry_is_bit_exact_on_every_platform)
{
    uint64_t digest = 14695981039346656037u;

    for (int i = -50000; i < 50000; i++) {
        digest = digest_with(digest, trig_sin(i / 1024.0));
        digest = digest_with(digest, trig_cos(i / 1024.0));
        digest = digest_with(digest, trig_hypot(i / 1024.0, 12.5));
    }
    TEST_ASSERT_EQUAL_HEX64(0xB5258719B6ABC89B, digest);
}

static struct bar bar;
static struct plant plant;
static struct obstacles obstacles;

BEFORE_EACH(clearance)
{
    bar = (struct bar){{80.0, 50.0}, {100.0, 50.0}};
    plant = (struct plant){{100.0, 50.0}, 5.0};
    obstacles = (struct obstacles){.width_mm = 200.0, .height_mm = 100.0, .bar_radius_mm = 2.0, .bars = &bar, .plants = &plant};
}

static double room(double x, double y)
{
    struct vector at = {x, y};
    double mm = clearance_mm(&obstacles, at);

    TEST_ASSERT_TRUE(clearance_suffices(&obstacles, at, mm));
    TEST_ASSERT_FALSE(clearance_suffices(&obstacles, at, mm + 1e-6));
    return mm;
}

TEST(clearance_is_the_distance_to_the_nearest_wall)
{
    TEST_ASSERT_EQUAL_DOUBLE(40.0, room(40.0, 50.0));
    TEST_ASSERT_EQUAL_DOUBLE(30.0, room(170.0, 50.0));
    TEST_ASSERT_EQUAL_DOUBLE(20.0, room(100.0, 20.0));
    TEST_ASSERT_EQUAL_DOUBLE(10.0, room(100.0, 90.0));
}

TEST(clearance_is_negative_beyond_a_wall)
{
    TEST_ASSERT_EQUAL_DOUBLE(-5.0, room(-5.0, 50.0));
    TEST_ASSERT_EQUAL_DOUBLE(-6.0, room(100.0, 106.0));
}

TEST(clearance_of_a_bar_is_to_its_side_or_end_cap)
{
    obstacles.bar_count = 1;
    TEST_ASSERT_EQUAL_DOUBLE(8.0, room(90.0, 60.0));
    TEST_ASSERT_EQUAL_DOUBLE(3.0, room(77.0, 54.0));
    TEST_ASSERT_EQUAL_DOUBLE(4.0, room(106.0, 50.0));
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, room(90.0, 49.0));
}

TEST(clearance_of_a_plant_is_to_its_rim)
{
    obstacles.plant_count = 1;
    TEST_ASSERT_EQUAL_DOUBLE(15.0, room(112.0, 66.0));
    TEST_ASSERT_EQUAL_DOUBLE(-5.0, room(100.0, 50.0));
}

static const struct bar BARS[] = {{{500.0, 600.0}, {900.0, 600.0}}, {{100.0, 100.0}, {100.0, 300.0}}};
static struct furniture furniture;

BEFORE_EACH(furniture)
{
    furniture = (struct furniture){.width_mm = 4000.0, .height_mm = 3000.0, .bar_radius_mm = 20.0, .plant_count = 3};
    furniture_set(&furniture, BARS, 2);
}

TEST(furniture_set_numbers_bars_and_clears_plants)
{
    TEST_ASSERT_EQUAL_size_t(2, furniture.bar_count);
    TEST_ASSERT_EQUAL_size_t(0, furniture.plant_count);
    TEST_ASSERT_EQUAL_UINT32(1, furniture.bar_ids[1]);
    TEST_ASSERT_EQUAL_UINT32(2, furniture.next_bar_id);
    TEST_ASSERT_EQUAL_UINT32(0, furniture.next_plant_id);
}

TEST(capsules_are_ordered_walls_bars_plants)
{
    const struct capsule *capsules = furniture.capsules;

    furniture.plants[furniture.plant_count++] = (struct plant){{2000.0, 1000.0}, 80.0};
    furniture_lay_out(&furniture);
    TEST_ASSERT_EQUAL_size_t(WALLS + 3, furniture.capsule_count);
    TEST_ASSERT_EQUAL_DOUBLE(4100.0, capsules[1].a.x);
    TEST_ASSERT_EQUAL_DOUBLE(500.0, capsules[WALLS].a.x);
    TEST_ASSERT_EQUAL_DOUBLE(20.0, capsules[WALLS].radius_mm);
    TEST_ASSERT_EQUAL_DOUBLE(300.0, capsules[WALLS + 1].b.y);
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, capsules[WALLS + 2].a.x);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, capsules[WALLS + 2].b.y);
    TEST_ASSERT_EQUAL_DOUBLE(80.0, capsules[WALLS + 2].radius_mm);
}

TEST(obstacles_equal_the_furniture)
{
    const struct obstacles around = furniture_obstacles(&furniture);

    TEST_ASSERT_EQUAL_DOUBLE(100.0, clearance_mm(&around, (struct vector){700.0, 480.0}));
    TEST_ASSERT_EQUAL_DOUBLE(50.0, clearance_mm(&around, (struct vector){3950.0, 1000.0}));
}

static struct capsule things[2];
static struct body bodies[2];
static struct world world;
static struct ranges ranges;

BEFORE_EACH(ranges)
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

TEST(ranges_in_the_open_are_none)
{
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}

TEST(bar_ahead_is_farther_away_in_oblique_cones)
{
    put(1150.0, 500.0, 1150.0, 1500.0);
    assert_ranges(RANGE_NONE, 41, 30, 41, RANGE_NONE);
}

TEST(end_of_a_bar_is_measured_in_its_direction)
{
    put(1000.0, 1135.4, 1000.0, 1500.0);
    assert_ranges(15, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}

TEST(range_is_to_the_nearest_obstacle)
{
    put(1000.0, 870.0, 1000.0, 500.0);
    put(1000.0, 850.0, 1000.0, 500.0);
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, 10);
}

TEST(range_of_an_overlapping_bar_is_0)
{
    put(1119.9, 1000.0, 1500.0, 1000.0);
    assert_ranges(RANGE_NONE, RANGE_NONE, 0, RANGE_NONE, RANGE_NONE);
}

TEST(front_range_reaches_half_a_millimetre_farther)
{
    put(1180.4, 1000.0, 1500.0, 1000.0);
    assert_ranges(RANGE_NONE, RANGE_NONE, 60, RANGE_NONE, RANGE_NONE);
    bodies[0].x_mm -= 0.2;
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}

TEST(ranges_ignore_obstacles_behind)
{
    put(870.0, 1000.0, 500.0, 1000.0);
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}

TEST(range_to_a_body_is_none_if_either_is_lifted)
{
    bodies[1].x_mm = 1225.0;
    assert_ranges(RANGE_NONE, 57, 25, 57, RANGE_NONE);
    bodies[1].lifted = true;
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
    bodies[1].lifted = false;
    bodies[0].lifted = true;
    assert_ranges(RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE);
}
