#include "host_sim/world/native/kit/kit.h"
#include "tests/test.h"

enum { TICKS = 100 };

static struct kit kit;
static double counted_mm[KIT_WHEELS], rolled_mm[KIT_WHEELS];

static struct kit_kind kind;
static struct body body;

void setUp(void)
{
    for (unsigned i = 0; i < TRAIT_COUNT; i++) {
        kind.trait[i] = KIT_TRAITS[i].ideal;
        kind.tolerance[i] = 0;
    }
    body = (struct body){0};
}

static void draw(void)
{
    kit_draw(&kit, &kind, 1, 0);
}

/* All that the left wheel rolls in some ticks at a speed, and then at rest. */
static double roll(double mm_s, unsigned ticks)
{
    double way_mm = 0;

    for (unsigned i = 0; i < ticks + TICKS; i++) {
        rolled_mm[0] = rolled_mm[1] = i < ticks ? mm_s * 0.02 : 0;
        (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
        way_mm += rolled_mm[0];
    }
    return way_mm;
}

TEST(each_trait_of_the_kit_is_one_that_a_body_can_have)
{
    for (unsigned i = 0; i < TRAIT_COUNT; i++) {
        const struct trait_row *row = &KIT_TRAITS[i];

        TEST_ASSERT_TRUE(row->least <= row->ideal && row->ideal <= row->most);
        TEST_ASSERT_TRUE(row->least <= row->kit - row->tolerance && row->kit + row->tolerance <= row->most);
    }
}

TEST(an_ideal_body_is_left_as_it_is)
{
    struct senses senses = {.tick = 3, .feel = FEEL_FRONT};

    draw();
    TEST_ASSERT_EQUAL_DOUBLE(20.0, roll(200, 5));
    kit_sense(&kit, NULL, NULL, 3, &senses);
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, senses.feel);
}

TEST(another_robot_has_other_traits_and_each_is_within_its_tolerance)
{
    double first;

    kind.tolerance[TRAIT_LAG_MS] = 20;
    kind.trait[TRAIT_LAG_MS] = 50;
    draw();
    first = kit.trait[TRAIT_LAG_MS];
    TEST_ASSERT_DOUBLE_WITHIN(20, 50, first);
    kit_draw(&kit, &kind, 1, 1);
    TEST_ASSERT_TRUE(kit.trait[TRAIT_LAG_MS] < first || kit.trait[TRAIT_LAG_MS] > first);
    draw();
    TEST_ASSERT_EQUAL_DOUBLE(first, kit.trait[TRAIT_LAG_MS]);
}

TEST(late_wheels_roll_in_the_end_what_they_were_told)
{
    kind.trait[TRAIT_LAG_MS] = 60;
    draw();
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 40, roll(200, 10));
    kind.trait[TRAIT_LAG_MS] = 0;
    kind.trait[TRAIT_ACCELERATION_MM_S2] = 1000;
    draw();
    TEST_ASSERT_LESS_THAN_DOUBLE(44.1, roll(200, 10));
}

TEST(the_boards_own_controller_makes_the_way)
{
    kind.trait[TRAIT_MOTOR_MS] = 60;
    draw();
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 200, roll(200, 50));
    kind.trait[TRAIT_LEFT_MOTOR] = 0;
    draw();
    TEST_ASSERT_EQUAL_DOUBLE(0, roll(200, 50));
}

TEST(orders_below_the_dead_band_move_nothing)
{
    kind.trait[TRAIT_DEAD_MM_S] = 10;
    draw();
    TEST_ASSERT_EQUAL_DOUBLE(0, roll(9, 10));
    TEST_ASSERT_EQUAL_DOUBLE(2.2, roll(11, 10));
}

TEST(slack_hides_its_way_from_the_odometer)
{
    kind.trait[TRAIT_SLACK_MM] = 1;
    draw();
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 39.5, roll(200, 10));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -39, roll(-200, 10));
}

TEST(the_floor_sees_another_way_than_the_odometer_where_a_wheel_is_larger_or_slips)
{
    kind.trait[TRAIT_LEFT_WHEEL] = 1.01;
    draw();
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 40.4, roll(200, 10));
    kind.trait[TRAIT_LEFT_WHEEL] = 1;
    kind.trait[TRAIT_SLIP] = 0.1;
    draw();
    TEST_ASSERT_DOUBLE_WITHIN(1.5, 38, roll(200, 10));
    TEST_ASSERT_EQUAL_DOUBLE(0, counted_mm[0]);
}

TEST(an_odometer_counts_in_whole_steps)
{
    kind.trait[TRAIT_COUNT_MM] = 3;
    draw();
    rolled_mm[0] = 4;
    (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
    TEST_ASSERT_EQUAL_DOUBLE(3, counted_mm[0]);
}

TEST(orders_and_senses_come_late)
{
    struct senses senses = {.tick = 1, .odometer_left = 7};

    kind.trait[TRAIT_DRIVES_TICKS] = 2;
    kind.trait[TRAIT_SENSES_TICKS] = 1;
    draw();
    kit.senses_differ = false;
    for (unsigned i = 0; i < 3; i++) {
        rolled_mm[0] = 4;
        (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
        TEST_ASSERT_EQUAL_DOUBLE(i < 2 ? 0 : 4, rolled_mm[0]);
    }
    kit_sense(&kit, NULL, NULL, 1, &senses);
    TEST_ASSERT_EQUAL_UINT16(7, senses.odometer_left);   /* there are none before the first */
    for (unsigned times = 0; times < 2; times++) {   /* asked again in the same tick, it says the same */
        senses = (struct senses){.tick = 2, .odometer_left = 9};
        kit_sense(&kit, NULL, NULL, 2, &senses);
        TEST_ASSERT_EQUAL_UINT8(2, senses.tick);
        TEST_ASSERT_EQUAL_UINT16(7, senses.odometer_left);
    }
}

/* A post straight ahead of a body at (0, 0), so far beyond its rim. */
static uint8_t felt_at(double away_mm)
{
    static struct capsule post;
    static struct ranges ranges;
    static struct world world;
    struct senses senses = {.feel = FEEL_FRONT};
    static uint32_t tick;

    capsule_set(&post, (struct vector){100 + away_mm + 10, 0}, (struct vector){100 + away_mm + 10, 0}, 10);
    ranges = (struct ranges){.capsules = &post, .capsule_count = 1, .body_radius_mm = 100, .reach_mm = 200};
    kit.ranges = &ranges;
    kit_sense(&kit, &world, &body, ++tick, &senses);
    return senses.feel;
}

TEST(a_sensor_reaches_as_far_as_its_own_and_lets_go_farther_away)
{
    kind.trait[TRAIT_FRONT_MM] = 50;
    kind.trait[TRAIT_HYSTERESIS_MM] = 5;
    draw();
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(52));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(50));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(54));
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(56));
}

TEST(a_dark_wall_is_seen_from_nearer)
{
    kind.trait[TRAIT_WALL] = 0.3;
    draw();
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(30));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(15));
}

TEST(nearer_than_its_fold_a_thing_seems_to_go_away_again)
{
    kind.trait[TRAIT_FOLD_MM] = 40;
    draw();
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(58));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(32));
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(28));
}

TEST(a_narrow_cone_does_not_see_what_stands_beside_it)
{
    kind.trait[TRAIT_CONE_DEG] = 10;
    draw();
    body.heading_rad = 15.0 * 3.141592653589793 / 180.0;
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(30));
    body.heading_rad = 5.0 * 3.141592653589793 / 180.0;
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(30));
}

TEST(a_beam_widens_with_the_distance_and_narrows_where_the_beacon_is_faint)
{
    kind.trait[TRAIT_BEAM_DEG] = 2;
    kind.trait[TRAIT_BEACON_MM] = 2000;
    draw();
    TEST_ASSERT_TRUE(kit_sees(&kit, 100, -53, 100));
    TEST_ASSERT_FALSE(kit_sees(&kit, 100, 54, 100));
    TEST_ASSERT_TRUE(kit_sees(&kit, 1000, 74, 100));
    TEST_ASSERT_FALSE(kit_sees(&kit, 1000, -75, 100));
    TEST_ASSERT_TRUE(kit_sees(&kit, 1999, 51, 100));
    TEST_ASSERT_FALSE(kit_sees(&kit, 1999, 52, 100));
    TEST_ASSERT_FALSE(kit_sees(&kit, 2000, 0, 100));
}

TEST(a_fault_comes_on_top_of_what_a_body_has_and_goes_without_a_trace)
{
    struct body_faults faults = {.lag_ms = 60, .slack_deg = 3, .slip_percent = 5, .latency_ticks = 1, .dark_wall = true};

    kind.trait[TRAIT_SENSES_TICKS] = 1;
    draw();
    kit_suffer(&kit, &faults);
    TEST_ASSERT_EQUAL_DOUBLE(60, kit.trait[TRAIT_LAG_MS]);
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 1.0996, kit.trait[TRAIT_SLACK_MM]);
    TEST_ASSERT_EQUAL_DOUBLE(0.05, kit.trait[TRAIT_SLIP]);
    TEST_ASSERT_EQUAL_DOUBLE(2, kit.trait[TRAIT_SENSES_TICKS]);
    TEST_ASSERT_EQUAL_DOUBLE(0.3, kit.trait[TRAIT_WALL]);
    kit_suffer(&kit, &(struct body_faults){0});
    TEST_ASSERT_FALSE(kit.wheels_differ);
    for (unsigned i = 0; i < TRAIT_COUNT; i++)
        TEST_ASSERT_EQUAL_DOUBLE(kind.trait[i], kit.trait[i]);
}

TEST(a_weak_battery_slows_a_body_that_had_no_motors)
{
    draw();
    kit_suffer(&kit, &(struct body_faults){.weak_battery = true});
    TEST_ASSERT_LESS_THAN_DOUBLE(380, roll(400, 50));
}

TEST(a_body_that_was_never_drawn_can_suffer_too)
{
    kit = (struct kit){0};
    kit_suffer(&kit, &(struct body_faults){.latency_ticks = 2});
    TEST_ASSERT_FALSE(kit.wheels_differ);
    TEST_ASSERT_EQUAL_DOUBLE(60.5, kit.trait[TRAIT_FRONT_MM]);
}
