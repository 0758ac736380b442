#include "host_sim/world/native/body_faults.h"

#include <unity.h>

static struct body_faults faults;

void setUp(void)
{
    faults = (struct body_faults){0};
}

void tearDown(void) {}

static uint8_t felt(uint8_t feel, uint32_t tick)
{
    struct senses senses = {.feel = feel};

    body_faults_sense(&faults, tick, &senses);
    return senses.feel;
}

static void test_a_sound_body_is_told_as_it_is(void)
{
    struct drive drive = {.left_mm_s = -2047, .right_mm_s = 2047};

    body_faults_drive(&faults, &drive);
    TEST_ASSERT_EQUAL_UINT8(19, felt(19, 5));
    TEST_ASSERT_EQUAL_INT16(-2047, drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(2047, drive.right_mm_s);
}

static void test_a_mirrored_ring_has_right_for_left(void)
{
    faults.mirrored = true;
    TEST_ASSERT_EQUAL_UINT8(FEEL_LEFT | FEEL_FRONT_RIGHT, felt(FEEL_RIGHT | FEEL_FRONT_LEFT, 0));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt(FEEL_FRONT, 0));
}

static void test_stuck_sensors_see_always_or_never(void)
{
    faults.stuck_on = FEEL_FRONT;
    faults.stuck_off = FEEL_LEFT;
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt(FEEL_LEFT, 0));
}

static void test_swapped_motors_are_swapped_with_their_odometers(void)
{
    struct senses senses = {.odometer_left = 3, .odometer_right = 4095};
    struct drive drive = {.left_mm_s = 200, .right_mm_s = -150};

    faults.swapped = true;
    body_faults_sense(&faults, 0, &senses);
    body_faults_drive(&faults, &drive);
    TEST_ASSERT_EQUAL_UINT16(4095, senses.odometer_left);
    TEST_ASSERT_EQUAL_UINT16(3, senses.odometer_right);
    TEST_ASSERT_EQUAL_INT16(-150, drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(200, drive.right_mm_s);
}

static void test_a_weak_motor_turns_at_its_share_of_the_speed_toward_0(void)
{
    struct drive drive = {.left_mm_s = -201, .right_mm_s = 200};

    faults.left_lost_percent = 40;
    faults.right_lost_percent = 100;
    body_faults_drive(&faults, &drive);
    TEST_ASSERT_EQUAL_INT16(-120, drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(0, drive.right_mm_s);
}

static void roll(struct body *body, int left_mm_s, int right_mm_s)
{
    struct drive drive = {.left_mm_s = (int16_t)left_mm_s, .right_mm_s = (int16_t)right_mm_s};
    struct world world = {.params = {.tick_s = 0.02, .max_wheel_speed_mm_s = 500.0}};

    body->lifted = true;
    body_faults_move(&faults, &world, body, &drive);
}

static void test_sound_odometers_count_the_way(void)
{
    struct body body = {.left_mm = 1.0};

    roll(&body, 200, -100);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(-2.0, body.right_mm);
}

static void test_a_stuck_odometer_stands_still_and_a_reversed_one_counts_backward(void)
{
    struct body body = {.left_mm = 1.1, .right_mm = 7.0};

    faults.left_miscounted_percent = -100;
    faults.right_miscounted_percent = -200;
    roll(&body, 200, 100);
    TEST_ASSERT_EQUAL_DOUBLE(1.1, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, body.right_mm);
}

static void test_swapped_odometers_count_each_others_wheels(void)
{
    struct body body = {.left_mm = 0.0};

    faults.odometers_swapped = true;
    faults.left_miscounted_percent = 50;
    roll(&body, 200, 100);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, body.right_mm);
}

static void test_odometers_count_what_weak_motors_turn(void)
{
    struct body body = {.left_mm = 0.0};

    faults.left_lost_percent = 50;
    roll(&body, 200, 100);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, body.right_mm);
}

static void test_a_false_beacon_shows_food_only_where_none_is_seen(void)
{
    struct senses none = {.look = false}, real = {.look = true, .beacon_mm = 700};

    faults.false_beacon_mm = 100;
    body_faults_sense(&faults, 0, &none);
    body_faults_sense(&faults, 0, &real);
    TEST_ASSERT_TRUE(none.look);
    TEST_ASSERT_EQUAL_UINT16(100, none.beacon_mm);
    TEST_ASSERT_EQUAL_UINT16(700, real.beacon_mm);
}

static void test_noise_follows_from_known_numbers(void)
{
    static const uint8_t expected[] = {3, 18, 19, 22, 16, 16};

    faults.noise = 300;
    faults.noise_of = 1000;
    faults.noise_key = 7;
    for (uint32_t tick = 0; tick < sizeof expected; tick++)
        TEST_ASSERT_EQUAL_UINT8(expected[tick], felt(0, tick));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_sound_body_is_told_as_it_is);
    RUN_TEST(test_a_mirrored_ring_has_right_for_left);
    RUN_TEST(test_stuck_sensors_see_always_or_never);
    RUN_TEST(test_swapped_motors_are_swapped_with_their_odometers);
    RUN_TEST(test_a_weak_motor_turns_at_its_share_of_the_speed_toward_0);
    RUN_TEST(test_sound_odometers_count_the_way);
    RUN_TEST(test_a_stuck_odometer_stands_still_and_a_reversed_one_counts_backward);
    RUN_TEST(test_swapped_odometers_count_each_others_wheels);
    RUN_TEST(test_odometers_count_what_weak_motors_turn);
    RUN_TEST(test_a_false_beacon_shows_food_only_where_none_is_seen);
    RUN_TEST(test_noise_follows_from_known_numbers);
    return UNITY_END();
}
