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
    RUN_TEST(test_noise_follows_from_known_numbers);
    return UNITY_END();
}
