#include "host_sim/world/native/body_faults.h"
#include "host_sim/world/native/world.h"
#include "tests/test.h"

static struct body_faults faults;

void setUp(void)
{
    faults = (struct body_faults){0};
}

static uint8_t felt(uint8_t feel, uint32_t tick)
{
    struct senses senses = {.feel = feel};

    body_faults_sense(&faults, tick, &senses);
    return senses.feel;
}

static void assert_driven(double left_mm_s, double right_mm_s, double left_told_mm_s, double right_told_mm_s)
{
    body_faults_drive(&faults, &left_told_mm_s, &right_told_mm_s);
    TEST_ASSERT_EQUAL_DOUBLE(left_mm_s, left_told_mm_s);
    TEST_ASSERT_EQUAL_DOUBLE(right_mm_s, right_told_mm_s);
}

TEST(a_sound_body_is_told_as_it_is)
{
    TEST_ASSERT_EQUAL_UINT8(19, felt(19, 5));
    assert_driven(-2047.0, 0.5, -2047.0, 0.5);
}

TEST(a_mirrored_ring_has_right_for_left)
{
    faults.mirrored = true;
    TEST_ASSERT_EQUAL_UINT8(FEEL_LEFT | FEEL_FRONT_RIGHT, felt(FEEL_RIGHT | FEEL_FRONT_LEFT, 0));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt(FEEL_FRONT, 0));
}

TEST(stuck_sensors_see_always_or_never)
{
    faults.stuck_on = FEEL_FRONT;
    faults.stuck_off = FEEL_LEFT;
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt(FEEL_LEFT, 0));
}

TEST(swapped_motors_are_swapped_with_their_odometers)
{
    struct senses senses = {.odometer_left = 3, .odometer_right = 4095};

    faults.swapped = true;
    body_faults_sense(&faults, 0, &senses);
    TEST_ASSERT_EQUAL_UINT16(4095, senses.odometer_left);
    TEST_ASSERT_EQUAL_UINT16(3, senses.odometer_right);
    assert_driven(-150.0, 200.0, 200.0, -150.0);
}

TEST(a_weak_motor_turns_at_its_share_of_the_speed_toward_0)
{
    faults.left_lost_percent = 40;
    faults.right_lost_percent = 100;
    assert_driven(-120.0, 0.0, -201.0, 200.0);
}

static void roll(struct body *body, int left_mm_s, int right_mm_s)
{
    struct world world = {.params = {.tick_s = 0.02, .max_wheel_speed_mm_s = 500.0}};

    body->lifted = true;
    body->faults = faults;
    world_move(&world, body, left_mm_s, right_mm_s);
}

TEST(sound_odometers_count_the_way)
{
    struct body body = {.left_mm = 1.0};

    roll(&body, 200, -100);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(-2.0, body.right_mm);
}

TEST(a_stuck_odometer_stands_still_and_a_reversed_one_counts_backward)
{
    struct body body = {.left_mm = 1.1, .right_mm = 7.0};

    faults.left_miscounted_percent = -100;
    faults.right_miscounted_percent = -200;
    roll(&body, 200, 100);
    TEST_ASSERT_EQUAL_DOUBLE(1.1, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, body.right_mm);
}

TEST(swapped_odometers_count_each_others_wheels)
{
    struct body body = {.left_mm = 0.0};

    faults.odometers_swapped = true;
    faults.left_miscounted_percent = 50;
    roll(&body, 200, 100);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, body.right_mm);
}

TEST(odometers_count_what_weak_motors_turn)
{
    struct body body = {.left_mm = 0.0};

    faults.left_lost_percent = 50;
    roll(&body, 200, 100);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, body.right_mm);
}

TEST(a_false_beacon_shows_food_only_where_none_is_seen)
{
    struct senses none = {.look = false}, real = {.look = true, .beacon_mm = 700};

    faults.false_beacon_mm = 100;
    body_faults_sense(&faults, 0, &none);
    body_faults_sense(&faults, 0, &real);
    TEST_ASSERT_TRUE(none.look);
    TEST_ASSERT_EQUAL_UINT16(100, none.beacon_mm);
    TEST_ASSERT_EQUAL_UINT16(700, real.beacon_mm);
}

TEST(noise_follows_from_known_numbers)
{
    static const uint8_t expected[] = {3, 18, 19, 22, 16, 16};

    faults.noise = 300;
    faults.noise_of = 1000;
    faults.noise_key = 7;
    for (uint32_t tick = 0; tick < sizeof expected; tick++)
        TEST_ASSERT_EQUAL_UINT8(expected[tick], felt(0, tick));
}

TEST(a_mirrored_ring_measures_the_other_way_round)
{
    uint8_t range_mm[FEEL_COUNT] = {10, 20, 30, 40, RANGE_NONE};
    const uint8_t expected[FEEL_COUNT] = {RANGE_NONE, 40, 30, 20, 10};

    faults.mirrored = true;
    body_faults_measure(&faults, range_mm);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, range_mm, FEEL_COUNT);
}

TEST(a_stuck_sensor_measures_nothing_but_that)
{
    uint8_t range_mm[FEEL_COUNT] = {10, 20, RANGE_NONE, 40, 50};
    const uint8_t expected[FEEL_COUNT] = {RANGE_NONE, 20, 0, 40, 50};

    faults.stuck_on = FEEL_FRONT;
    faults.stuck_off = FEEL_RIGHT;
    body_faults_measure(&faults, range_mm);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, range_mm, FEEL_COUNT);
}
