#include "firmware/pattern.h"

#include <unity.h>

enum { RIGHT = 1, FRONT_RIGHT = 2, FRONT = 4, FRONT_LEFT = 8, LEFT = 16 };

void setUp(void) {}
void tearDown(void) {}

static void test_front_right_is_bit_0(void)
{
    TEST_ASSERT_EQUAL_UINT8(1, pattern_of(FRONT_RIGHT));
}

static void test_front_is_bit_1(void)
{
    TEST_ASSERT_EQUAL_UINT8(2, pattern_of(FRONT));
}

static void test_front_left_is_bit_2(void)
{
    TEST_ASSERT_EQUAL_UINT8(4, pattern_of(FRONT_LEFT));
}

static void test_the_side_sensors_leave_the_way_clear(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, pattern_of(RIGHT | LEFT));
}

static void test_the_side_sensors_change_no_pattern(void)
{
    for (unsigned front = 0; front < 8; front++)
        TEST_ASSERT_EQUAL_UINT8(front, pattern_of((uint8_t)(front << 1 | RIGHT | LEFT)));
}

static void test_what_is_no_sensor_changes_no_pattern(void)
{
    TEST_ASSERT_EQUAL_UINT8(0, pattern_of(0xE0));
}

static void test_the_count_is_the_number_of_triggered_sensors(void)
{
    static const uint8_t counts[8] = {0, 1, 1, 2, 1, 2, 2, 3};

    for (uint8_t pattern = 0; pattern < 8; pattern++)
        TEST_ASSERT_EQUAL_UINT8(counts[pattern], pattern_count(pattern));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_front_right_is_bit_0);
    RUN_TEST(test_front_is_bit_1);
    RUN_TEST(test_front_left_is_bit_2);
    RUN_TEST(test_the_side_sensors_leave_the_way_clear);
    RUN_TEST(test_the_side_sensors_change_no_pattern);
    RUN_TEST(test_what_is_no_sensor_changes_no_pattern);
    RUN_TEST(test_the_count_is_the_number_of_triggered_sensors);
    return UNITY_END();
}
