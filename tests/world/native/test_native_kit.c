#include "tests/test.h"
#include "host_sim/world/native/kit/kit.h"

#include <string.h>

enum { TICKS = 100 };

static struct kit kit;
static double counted_mm[KIT_WHEELS], rolled_mm[KIT_WHEELS];

static struct kit_kind kind;
static struct body body;

BEFORE_EACH(kit)
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

/* The distance that the left wheel rolls in some ticks at a speed, and then at rest. */
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

TEST(trait_defaults_and_tolerances_are_within_limits)
{
    for (unsigned i = 0; i < TRAIT_COUNT; i++) {
        const struct trait_row *row = &KIT_TRAITS[i];

        TEST_ASSERT_TRUE(row->least <= row->ideal && row->ideal <= row->most);
        TEST_ASSERT_TRUE(row->least <= row->kit - row->tolerance && row->kit + row->tolerance <= row->most);
    }
}

TEST(ideal_kit_changes_neither_motion_nor_senses)
{
    struct senses senses = {.tick = 3, .feel = FEEL_FRONT};

    draw();
    TEST_ASSERT_EQUAL_DOUBLE(20.0, roll(200, 5));
    kit_sense(&kit, NULL, NULL, 3, &senses);
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, senses.feel);
}

TEST(traits_differ_by_robot_within_tolerance)
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

TEST(lagging_wheels_roll_the_commanded_distance_in_the_end)
{
    kind.trait[TRAIT_LAG_MS] = 60;
    draw();
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 40, roll(200, 10));
    kind.trait[TRAIT_LAG_MS] = 0;
    kind.trait[TRAIT_ACCELERATION_MM_S2] = 1000;
    draw();
    TEST_ASSERT_LESS_THAN_DOUBLE(44.1, roll(200, 10));
}

TEST(kit_with_motors_rolls_as_its_speed_controller_does)
{
    kind.trait[TRAIT_MOTOR_MS] = 60;
    draw();
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 200, roll(200, 50));
    kind.trait[TRAIT_LEFT_MOTOR] = 0;
    draw();
    TEST_ASSERT_EQUAL_DOUBLE(0, roll(200, 50));
}

TEST(speed_below_the_dead_band_causes_no_motion)
{
    kind.trait[TRAIT_DEAD_MM_S] = 10;
    draw();
    TEST_ASSERT_EQUAL_DOUBLE(0, roll(9, 10));
    TEST_ASSERT_EQUAL_DOUBLE(2.2, roll(11, 10));
}

TEST(slack_shortens_the_distance_rolled)
{
    kind.trait[TRAIT_SLACK_MM] = 1;
    draw();
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 39.5, roll(200, 10));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -39, roll(-200, 10));
}

TEST(wheel_size_and_slip_change_the_distance_rolled)
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

TEST(odometer_counts_whole_steps)
{
    kind.trait[TRAIT_COUNT_MM] = 3;
    draw();
    rolled_mm[0] = 4;
    (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
    TEST_ASSERT_EQUAL_DOUBLE(3, counted_mm[0]);
}

TEST(drives_and_senses_are_delayed)
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
    TEST_ASSERT_EQUAL_UINT16(7, senses.odometer_left);   /* there are no earlier ones */
    for (unsigned times = 0; times < 2; times++) {   /* the same result twice in a tick */
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

TEST(sensor_has_its_own_reach_and_hysteresis)
{
    kind.trait[TRAIT_FRONT_MM] = 50;
    kind.trait[TRAIT_HYSTERESIS_MM] = 5;
    draw();
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(52));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(50));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(54));
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(56));
}

TEST(dark_wall_reduces_the_sensor_reach)
{
    kind.trait[TRAIT_WALL] = 0.3;
    draw();
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(30));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(15));
}

TEST(reading_below_the_fold_distance_rises_again)
{
    kind.trait[TRAIT_FOLD_MM] = 40;
    draw();
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(58));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(32));
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(28));
}

TEST(narrow_cone_misses_a_post_at_its_side)
{
    kind.trait[TRAIT_CONE_DEG] = 10;
    draw();
    body.heading_rad = 15.0 * 3.141592653589793 / 180.0;
    TEST_ASSERT_EQUAL_UINT8(0, felt_at(30));
    body.heading_rad = 5.0 * 3.141592653589793 / 180.0;
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt_at(30));
}

TEST(beam_widens_with_distance_and_narrows_near_its_limit)
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

TEST(faults_add_to_traits_and_are_removed_completely)
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

TEST(weak_battery_slows_a_kit_without_motors)
{
    draw();
    kit_suffer(&kit, &(struct body_faults){.weak_battery = true});
    TEST_ASSERT_LESS_THAN_DOUBLE(380, roll(400, 50));
}

TEST(fault_of_an_undrawn_kit_applies_to_ideal_traits)
{
    kit = (struct kit){0};
    kit_suffer(&kit, &(struct body_faults){.latency_ticks = 2});
    TEST_ASSERT_FALSE(kit.wheels_differ);
    TEST_ASSERT_EQUAL_DOUBLE(60.5, kit.trait[TRAIT_FRONT_MM]);
}

/* A kit whose board drives the motors itself, and measures light. */

enum { PERIODS = 200, HALF = 32768 };

static struct kit by_speeds;

BEFORE_EACH(kit_push)
{
    struct kit_kind built = {.tolerance = {0}};

    for (unsigned i = 0; i < TRAIT_COUNT; i++)
        built.trait[i] = KIT_TRAITS[i].kit;
    built.trait[TRAIT_SLIP] = built.trait[TRAIT_NOISE_MM] = 0;
    kit = by_speeds = (struct kit){0};
    kit_draw(&kit, &built, 1, 0);
    kit_draw(&by_speeds, &built, 1, 0);
}

static void push(int32_t left, int32_t right, unsigned periods)
{
    const int32_t duty[KIT_WHEELS] = {left, right};

    for (unsigned i = 0; i < periods; i++)
        kit_push(&kit, duty);
}

TEST(kit_driven_by_duties_ignores_speeds)
{
    uint16_t left = kit_count(&kit, 0), right = kit_count(&kit, 1);

    push(HALF, -HALF, PERIODS);
    rolled_mm[0] = rolled_mm[1] = 99;
    (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
    TEST_ASSERT_DOUBLE_WITHIN(0.1, 0.0916 * (int16_t)(uint16_t)(kit_count(&kit, 0) - left), counted_mm[0]);
    TEST_ASSERT_DOUBLE_WITHIN(0.2, 0.0916 * (int16_t)(uint16_t)(kit_count(&kit, 1) - right), counted_mm[1]);
    TEST_ASSERT_DOUBLE_WITHIN(0.5, counted_mm[0], rolled_mm[0]);
    TEST_ASSERT_TRUE(counted_mm[0] > 200 && counted_mm[1] < -200);
}

TEST(tick_without_a_duty_does_not_roll)
{
    push(HALF, HALF, PERIODS);
    (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
    (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
    TEST_ASSERT_EQUAL_DOUBLE(0, rolled_mm[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0, counted_mm[1]);
}

/* The board's own controller, in the world and outside of it. */
TEST(kit_driven_by_duties_rolls_as_far_as_by_speeds)
{
    struct wheel wheels[KIT_WHEELS] = {{.known = false}};
    double by_speeds_mm = 0;

    for (unsigned tick = 0; tick < 50; tick++) {
        rolled_mm[0] = rolled_mm[1] = 200 * 0.02;
        (void)kit_roll(&by_speeds, 0.02, counted_mm, rolled_mm);
        by_speeds_mm += counted_mm[0];
    }
    for (unsigned period = 0; period < 200; period++) {
        int32_t duty[KIT_WHEELS];

        for (unsigned side = 0; side < KIT_WHEELS; side++)
            duty[side] = wheel_run(&wheels[side], kit_count(&kit, side), 200, (uint32_t)(kit.trait[TRAIT_BATTERY_V] * 1000));
        kit_push(&kit, duty);
    }
    (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
    TEST_ASSERT_DOUBLE_WITHIN(1.0, by_speeds_mm, counted_mm[0]);
}

TEST(wall_at_sensor_reach_gives_the_threshold_light)
{
    struct capsule wall;
    struct ranges ranges = {.body_radius_mm = 100, .reach_mm = 180, .capsules = &wall, .capsule_count = 1};
    struct body robot = {.ahead = {1, 0}, .feel = FEEL_RIGHT};
    struct world world = {.params = {.tick_s = 0.02}};
    uint16_t light[FEEL_COUNT];

    capsule_set(&wall, (struct vector){-500, 160}, (struct vector){500, 160}, 0);
    kit.ranges = &ranges;
    kit_light(&kit, &world, &robot, 0, light);
    TEST_ASSERT_UINT_WITHIN(40, KIT_LIGHT_NEAR, light[0] > light[FEEL_COUNT - 1] ? light[0] : light[FEEL_COUNT - 1]);
    TEST_ASSERT_EQUAL_UINT16(0, light[2]);
    robot.feel = 0;
    kit_light(&kit, &world, &robot, 0, light);
    TEST_ASSERT_EQUAL_UINT16(0, light[0]);
}
