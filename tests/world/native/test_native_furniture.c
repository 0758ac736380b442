#include "host_sim/world/native/edits.h"
#include "tests/test.h"

static const struct bar BARS[] = {{{500.0, 600.0}, {900.0, 600.0}}, {{100.0, 100.0}, {100.0, 300.0}}};
static struct furniture furniture;

void setUp(void)
{
    furniture = (struct furniture){.width_mm = 4000.0, .height_mm = 3000.0, .bar_radius_mm = 20.0, .plant_count = 3};
    furniture_set(&furniture, BARS, 2);
}

TEST(bars_are_numbered_from_0_on_and_nothing_else_is_there)
{
    TEST_ASSERT_EQUAL_size_t(2, furniture.bar_count);
    TEST_ASSERT_EQUAL_size_t(0, furniture.plant_count);
    TEST_ASSERT_EQUAL_UINT32(1, furniture.bar_ids[1]);
    TEST_ASSERT_EQUAL_UINT32(2, furniture.next_bar_id);
    TEST_ASSERT_EQUAL_UINT32(0, furniture.next_plant_id);
}

TEST(walls_come_first_then_bars_then_plants)
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

TEST(obstacles_are_the_same_things)
{
    const struct obstacles obstacles = furniture_obstacles(&furniture);

    TEST_ASSERT_EQUAL_DOUBLE(100.0, clearance_mm(&obstacles, (struct vector){700.0, 480.0}));
    TEST_ASSERT_EQUAL_DOUBLE(50.0, clearance_mm(&obstacles, (struct vector){3950.0, 1000.0}));
}
