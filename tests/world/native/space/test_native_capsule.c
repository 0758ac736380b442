#include "host_sim/world/native/space/capsule.h"
#include "tests/test.h"

static const struct vector CENTRE = {1000.0, 1000.0};
static struct capsule bar;
static struct contact contact;
static struct cones cones;

void setUp(void)
{
    capsule_set(&bar, (struct vector){900.0, 1110.0}, (struct vector){1100.0, 1110.0}, 20.0);
    cones_set(&cones, 160.0, 0.5);
}

TEST(disc_overlaps_the_side_of_a_capsule)
{
    capsule_meet_disc(&bar, CENTRE, 100.0, &contact);
    TEST_ASSERT_TRUE(contact.touches);
    TEST_ASSERT_EQUAL_DOUBLE(110.0 * 110.0, contact.apart_mm2);
    TEST_ASSERT_EQUAL_DOUBLE(10.0, contact.depth_mm);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, contact.normal.x);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, contact.normal.y);
}

TEST(disc_overlaps_the_end_cap_of_a_capsule)
{
    capsule_meet_disc(&bar, (struct vector){1160.0, 1190.0}, 100.0, &contact);
    TEST_ASSERT_TRUE(contact.touches);
    TEST_ASSERT_EQUAL_DOUBLE(100.0 * 100.0, contact.apart_mm2);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 20.0, contact.depth_mm);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.6, contact.normal.x);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, -0.8, contact.normal.y);
}

TEST(tangent_disc_does_not_overlap)
{
    capsule_meet_disc(&bar, CENTRE, 90.0, &contact);
    TEST_ASSERT_FALSE(contact.touches);
}

TEST(disc_on_the_centre_line_is_pushed_sideways)
{
    capsule_meet_disc(&bar, (struct vector){1000.0, 1110.0}, 100.0, &contact);
    TEST_ASSERT_EQUAL_DOUBLE(120.0, contact.depth_mm);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, contact.normal.y);
}

TEST(discs_overlap_along_the_line_between_their_centres)
{
    capsule_meet_discs(CENTRE, (struct vector){1150.0, 1000.0}, 100.0, &contact);
    TEST_ASSERT_TRUE(contact.touches);
    TEST_ASSERT_EQUAL_DOUBLE(50.0, contact.depth_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, contact.normal.x);
    capsule_meet_discs(CENTRE, (struct vector){1200.0, 1000.0}, 100.0, &contact);
    TEST_ASSERT_FALSE(contact.touches);
    capsule_meet_discs(CENTRE, CENTRE, 100.0, &contact);
    TEST_ASSERT_EQUAL_DOUBLE(200.0, contact.depth_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, contact.normal.x);
}

TEST(inner_faces_of_the_walls_are_the_edge_of_the_arena)
{
    static const struct vector INSIDE[] = {{2000.0, 99.0}, {3901.0, 1500.0}, {2000.0, 2901.0}, {99.0, 1500.0}};
    struct capsule walls[WALLS];

    capsule_set_walls(walls, 4000.0, 3000.0);
    for (unsigned place = 0; place < WALLS; place++)
        for (unsigned wall = 0; wall < WALLS; wall++) {
            capsule_meet_disc(&walls[wall], INSIDE[place], 100.0, &contact);
            TEST_ASSERT_EQUAL_INT(place == wall, contact.touches);
            if (contact.touches)
                TEST_ASSERT_DOUBLE_WITHIN(1e-9, 1.0, contact.depth_mm);
        }
}

TEST(capsule_distance_is_bounded_by_its_box)
{
    static const struct vector FAR[] = {{879.0, 1100.0}, {1121.0, 1100.0}, {1000.0, 1089.0}, {1000.0, 1131.0}};

    TEST_ASSERT_EQUAL_DOUBLE(-20.0, capsule_apart_mm(&bar, (struct vector){1000.0, 1110.0}));
    for (unsigned i = 0; i < sizeof FAR / sizeof *FAR; i++)
        TEST_ASSERT_EQUAL_DOUBLE(1.0, capsule_apart_mm(&bar, FAR[i]));
}

static bool hides(double x, double y)
{
    return capsule_hides(&bar, CENTRE, (struct vector){x, y});
}

TEST(capsule_hides_points_behind_it)
{
    TEST_ASSERT_TRUE(hides(1000.0, 1200.0));
    TEST_ASSERT_TRUE(hides(900.0, 1300.0));
    TEST_ASSERT_FALSE(hides(1000.0, 1089.0));
    TEST_ASSERT_FALSE(hides(1000.0, 800.0));
    TEST_ASSERT_FALSE(hides(1300.0, 1110.0));
}

TEST(capsule_end_caps_hide_points_behind)
{
    TEST_ASSERT_TRUE(hides(1200.0, 1180.0));
    TEST_ASSERT_TRUE(hides(800.0, 1180.0));
    TEST_ASSERT_FALSE(hides(1200.0, 1160.0));
    TEST_ASSERT_FALSE(hides(1105.0, 1085.0));
}

TEST(point_inside_a_capsule_sees_nothing)
{
    TEST_ASSERT_TRUE(capsule_hides(&bar, (struct vector){1000.0, 1095.0}, (struct vector){1000.0, 0.0}));
    TEST_ASSERT_TRUE(capsule_disc_hides(CENTRE, 100.0, (struct vector){1050.0, 1000.0}, (struct vector){2000.0, 0.0}));
}

TEST(disc_hides_points_behind_it)
{
    const struct vector from = {500.0, 1000.0};

    TEST_ASSERT_TRUE(capsule_disc_hides(CENTRE, 100.0, from, (struct vector){1200.0, 1000.0}));
    TEST_ASSERT_FALSE(capsule_disc_hides(CENTRE, 100.0, from, (struct vector){890.0, 1000.0}));
    TEST_ASSERT_FALSE(capsule_disc_hides(CENTRE, 100.0, from, (struct vector){0.0, 1000.0}));
    TEST_ASSERT_FALSE(capsule_disc_hides(CENTRE, 100.0, from, (struct vector){1200.0, 1300.0}));
}

TEST(capsule_of_no_length_hides_points_behind_it)
{
    struct capsule plant;

    capsule_set(&plant, CENTRE, CENTRE, 80.0);
    TEST_ASSERT_TRUE(capsule_hides(&plant, (struct vector){500.0, 1000.0}, (struct vector){1200.0, 1000.0}));
    TEST_ASSERT_FALSE(capsule_hides(&plant, (struct vector){500.0, 1000.0}, (struct vector){910.0, 1000.0}));
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

TEST(cone_detects_capsules_in_its_direction)
{
    TEST_ASSERT_EQUAL_HEX(1, felt_at(0.0, 120.0));
    TEST_ASSERT_EQUAL_HEX(2, felt_at(85.0, 85.0));
    TEST_ASSERT_EQUAL_HEX(4, felt_at(120.0, 0.0));
    TEST_ASSERT_EQUAL_HEX(8, felt_at(85.0, -85.0));
    TEST_ASSERT_EQUAL_HEX(16, felt_at(0.0, -120.0));
}

TEST(cones_detect_no_capsule_behind_the_body)
{
    TEST_ASSERT_EQUAL_HEX(0, felt_at(-120.0, 0.0));
    TEST_ASSERT_EQUAL_HEX(0, felt(-150.0, -300.0, -200.0, 300.0));
}

TEST(front_cone_reaches_half_a_millimetre_farther)
{
    TEST_ASSERT_EQUAL_HEX(4, felt_at(180.2, 0.0));
    TEST_ASSERT_EQUAL_HEX(0, felt_at(180.9, 0.0));
    TEST_ASSERT_EQUAL_HEX(1, felt_at(0.0, 179.8));
    TEST_ASSERT_EQUAL_HEX(0, felt_at(0.0, 180.4));
    TEST_ASSERT_DOUBLE_WITHIN(0.5, 160.5, cones.reach_mm);
}

TEST(wall_ahead_is_in_the_three_front_cones)
{
    TEST_ASSERT_EQUAL_HEX(14, felt(150.0, -500.0, 150.0, 500.0));
    TEST_ASSERT_EQUAL_HEX(4, felt(180.2, -500.0, 180.2, 500.0));
    TEST_ASSERT_EQUAL_HEX(0, felt(181.0, -500.0, 181.0, 500.0));
}

TEST(cone_detects_a_bar_end_between_its_edges)
{
    TEST_ASSERT_EQUAL_HEX(4, felt(175.0, 17.0, 400.0, 17.0));
}

TEST(cone_detects_a_bar_across_it)
{
    const struct capsule thin = {.a = {100.0, -300.0}, .b = {100.0, 300.0}, .radius_mm = 0.001};
    const struct capsule inside = {.a = {100.0, 5.0}, .b = {110.0, 5.0}, .radius_mm = 0.001};

    TEST_ASSERT_EQUAL_HEX(2, felt_at(75.0, 85.0));
    TEST_ASSERT_TRUE(cones_overlap(&cones.of[2], &thin));
    TEST_ASSERT_FALSE(cones_overlap(&cones.of[0], &thin));
    TEST_ASSERT_TRUE(cones_overlap(&cones.of[2], &inside));
    TEST_ASSERT_FALSE(cones_overlap(&cones.of[1], &inside));
}
