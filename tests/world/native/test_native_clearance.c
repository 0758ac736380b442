#include "host_sim/world/native/draw/layout.h"
#include "tests/test.h"

static struct bar bar;
static struct plant plant;
static struct obstacles obstacles;

void setUp(void)
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

TEST(a_place_is_as_clear_as_the_nearest_wall_is_far)
{
    TEST_ASSERT_EQUAL_DOUBLE(40.0, room(40.0, 50.0));
    TEST_ASSERT_EQUAL_DOUBLE(30.0, room(170.0, 50.0));
    TEST_ASSERT_EQUAL_DOUBLE(20.0, room(100.0, 20.0));
    TEST_ASSERT_EQUAL_DOUBLE(10.0, room(100.0, 90.0));
}

TEST(beyond_a_wall_it_is_negative)
{
    TEST_ASSERT_EQUAL_DOUBLE(-5.0, room(-5.0, 50.0));
    TEST_ASSERT_EQUAL_DOUBLE(-6.0, room(100.0, 106.0));
}

TEST(a_bar_is_as_near_as_its_side_or_its_round_end)
{
    obstacles.bar_count = 1;
    TEST_ASSERT_EQUAL_DOUBLE(8.0, room(90.0, 60.0));
    TEST_ASSERT_EQUAL_DOUBLE(3.0, room(77.0, 54.0));
    TEST_ASSERT_EQUAL_DOUBLE(4.0, room(106.0, 50.0));
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, room(90.0, 49.0));
}

TEST(a_plant_is_as_near_as_its_rim)
{
    obstacles.plant_count = 1;
    TEST_ASSERT_EQUAL_DOUBLE(15.0, room(112.0, 66.0));
    TEST_ASSERT_EQUAL_DOUBLE(-5.0, room(100.0, 50.0));
}
