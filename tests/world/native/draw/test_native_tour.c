#include "host_sim/world/native/draw/tour.h"
#include "tests/test.h"

#include <math.h>

enum { TANGENTS = 4000 };

static const double PI = 3.14159265358979323846;

/* An arena of 4 by 3 metres with a body of 100 mm and bars of 40 mm: the centre keeps 120 mm off a bar's line. */
static const double BODY_MM = 100.0, ROOM_MM = 120.0;

static struct tour_tangent tangents[TANGENTS];
static struct tour tour;
static struct bar bars[TOUR_THINGS_MAX + 1];
static struct plant plant;
static struct obstacles obstacles;
static struct vector places[TOUR_PLACES_MAX + 1];

void setUp(void)
{
    tour = (struct tour){.tangents = tangents, .tangents_max = TANGENTS};
    obstacles = (struct obstacles){.width_mm = 4000.0, .height_mm = 3000.0, .bar_radius_mm = 20.0, .bars = bars, .plants = &plant};
    places[0] = (struct vector){1000.0, 1500.0};
    places[1] = (struct vector){3000.0, 1500.0};
}

static double way_mm(uint32_t count)
{
    return tour_mm(&tour, &obstacles, BODY_MM, places, count);
}

/* Around a circle that is right between the places: two tangents and the arc between them. */
static double around_mm(double half_mm, double radius_mm)
{
    return 2.0 * (sqrt(half_mm * half_mm - radius_mm * radius_mm) + radius_mm * asin(radius_mm / half_mm));
}

TEST(without_obstacles_the_way_is_straight)
{
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, way_mm(2));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, way_mm(1));
}

TEST(the_best_order_is_taken)
{
    places[1] = (struct vector){3000.0, 1500.0};
    places[2] = (struct vector){500.0, 1500.0};
    places[3] = (struct vector){2000.0, 1500.0};
    TEST_ASSERT_EQUAL_DOUBLE(500.0 + 2500.0, way_mm(4));
}

TEST(a_plant_is_gone_around)
{
    plant = (struct plant){{2000.0, 1500.0}, 80.0};
    obstacles.plant_count = 1;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, around_mm(1000.0, 180.0), way_mm(2));
}

TEST(a_bar_is_gone_around_at_its_nearer_end)
{
    bars[0] = (struct bar){{2000.0, 1500.0}, {2000.0, 2500.0}};
    obstacles.bar_count = 1;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, around_mm(1000.0, ROOM_MM), way_mm(2));
}

TEST(both_ends_of_a_bar_are_gone_around_where_it_is_lengthwise_in_the_way)
{
    bars[0] = (struct bar){{1500.0, 1500.0}, {2500.0, 1500.0}};
    obstacles.bar_count = 1;
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, around_mm(500.0, ROOM_MM) + 1000.0, way_mm(2));
}

TEST(there_is_no_way_where_the_body_does_not_fit)
{
    bars[0] = (struct bar){{2000.0, 0.0}, {2000.0, 2781.0}};   /* 3000 less twice the body and half the bar is 2780 */
    obstacles.bar_count = 1;
    TEST_ASSERT_TRUE(isinf(way_mm(2)));
    bars[0].b.y = 2779.0;
    TEST_ASSERT_TRUE(way_mm(2) > 2.0 * 1200.0);
}

TEST(an_arc_that_another_bar_blocks_is_not_taken)
{
    double free_mm;

    bars[0] = (struct bar){{2000.0, 1400.0}, {2000.0, 2900.0}};
    bars[1] = (struct bar){{2000.0, 0.0}, {2000.0, 1200.0}};   /* leaves 160 mm between their faces */
    obstacles.bar_count = 1;
    free_mm = way_mm(2);
    obstacles.bar_count = 2;
    TEST_ASSERT_TRUE(free_mm < 2100.0);
    TEST_ASSERT_TRUE(isinf(way_mm(2)));
}

TEST(the_far_side_of_a_circle_is_more_than_half_a_turn_away)
{
    plant = (struct plant){{1000.0, 1500.0 - 190.0}, 80.0};   /* 10 mm off the start, which leaves along its tangent or not */
    places[1] = (struct vector){1000.0, 500.0};
    obstacles.plant_count = 1;
    TEST_ASSERT_TRUE(way_mm(2) > 1000.0);
    TEST_ASSERT_TRUE(way_mm(2) < 810.0 + 180.0 * PI);
}

TEST(too_many_places_or_things_and_too_little_room_have_no_way)
{
    for (uint32_t i = 0; i <= TOUR_PLACES_MAX; i++)
        places[i] = (struct vector){300.0 * (i + 1), 300.0};
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 300.0 * (TOUR_PLACES_MAX - 1), way_mm(TOUR_PLACES_MAX));
    TEST_ASSERT_TRUE(isinf(way_mm(TOUR_PLACES_MAX + 1)));
    obstacles.bar_count = TOUR_THINGS_MAX + 1;
    TEST_ASSERT_TRUE(isinf(way_mm(2)));
    obstacles.bar_count = 0;
    tour.tangents_max = 2;   /* there and back fill it */
    TEST_ASSERT_TRUE(isinf(way_mm(2)));
}
