/* A kit whose board drives the motors itself, and measures light. */
#include <string.h>

#include "host_sim/world/native/kit/kit.h"
#include "tests/test.h"

enum { PERIODS = 200, HALF = 32768 };

static struct kit kit, told;
static double counted_mm[KIT_WHEELS], rolled_mm[KIT_WHEELS];

void setUp(void)
{
    struct kit_kind kind = {.tolerance = {0}};

    for (unsigned i = 0; i < TRAIT_COUNT; i++)
        kind.trait[i] = KIT_TRAITS[i].kit;
    kind.trait[TRAIT_SLIP] = kind.trait[TRAIT_NOISE_MM] = 0;
    kit = told = (struct kit){0};
    kit_draw(&kit, &kind, 1, 0);
    kit_draw(&told, &kind, 1, 0);
}

static void push(int32_t left, int32_t right, unsigned periods)
{
    const int32_t duty[KIT_WHEELS] = {left, right};

    for (unsigned i = 0; i < periods; i++)
        kit_push(&kit, duty);
}

TEST(a_pushed_body_rolls_as_far_as_its_encoders_count_whatever_it_is_told)
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

TEST(a_tick_without_a_push_rolls_no_farther)
{
    push(HALF, HALF, PERIODS);
    (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
    (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
    TEST_ASSERT_EQUAL_DOUBLE(0, rolled_mm[0]);
    TEST_ASSERT_EQUAL_DOUBLE(0, counted_mm[1]);
}

/* The board's own controller, in the world and outside of it. */
TEST(who_pushes_as_the_controller_does_comes_as_far)
{
    struct wheel wheels[KIT_WHEELS] = {{.known = false}};
    double by_orders_mm = 0;

    for (unsigned tick = 0; tick < 50; tick++) {
        rolled_mm[0] = rolled_mm[1] = 200 * 0.02;
        (void)kit_roll(&told, 0.02, counted_mm, rolled_mm);
        by_orders_mm += counted_mm[0];
    }
    for (unsigned period = 0; period < 200; period++) {
        int32_t duty[KIT_WHEELS];

        for (unsigned side = 0; side < KIT_WHEELS; side++)
            duty[side] = wheel_run(&wheels[side], kit_count(&kit, side), 200, (uint32_t)(kit.trait[TRAIT_BATTERY_V] * 1000));
        kit_push(&kit, duty);
    }
    (void)kit_roll(&kit, 0.02, counted_mm, rolled_mm);
    TEST_ASSERT_DOUBLE_WITHIN(1.0, by_orders_mm, counted_mm[0]);
}

TEST(a_wall_at_the_reach_of_a_sensor_gives_the_light_that_triggers_it)
{
    struct capsule wall;
    struct ranges ranges = {.body_radius_mm = 100, .reach_mm = 180, .capsules = &wall, .capsule_count = 1};
    struct body body = {.ahead = {1, 0}, .feel = FEEL_RIGHT};
    struct world world = {.params = {.tick_s = 0.02}};
    uint16_t light[FEEL_COUNT];

    capsule_set(&wall, (struct vector){-500, 160}, (struct vector){500, 160}, 0);
    kit.ranges = &ranges;
    kit_light(&kit, &world, &body, 0, light);
    TEST_ASSERT_UINT_WITHIN(40, KIT_LIGHT_NEAR, light[0] > light[FEEL_COUNT - 1] ? light[0] : light[FEEL_COUNT - 1]);
    TEST_ASSERT_EQUAL_UINT16(0, light[2]);
    body.feel = 0;
    kit_light(&kit, &world, &body, 0, light);
    TEST_ASSERT_EQUAL_UINT16(0, light[0]);
}
