#include "firmware/pattern.h"
#include "tests/test.h"

enum { RIGHT = 1, FRONT_RIGHT = 2, FRONT = 4, FRONT_LEFT = 8, LEFT = 16 };

TEST(each_front_sensor_has_its_bit)
{
    TEST_ASSERT_EQUAL_UINT8(1, pattern_of(FRONT_RIGHT));
    TEST_ASSERT_EQUAL_UINT8(2, pattern_of(FRONT));
    TEST_ASSERT_EQUAL_UINT8(4, pattern_of(FRONT_LEFT));
}

TEST(side_sensors_and_what_is_no_sensor_change_no_pattern)
{
    for (unsigned front = 0; front < 8; front++) {
        TEST_ASSERT_EQUAL_UINT8(front, pattern_of((uint8_t)(front << 1 | RIGHT | LEFT)));
        TEST_ASSERT_EQUAL_UINT8(front, pattern_of((uint8_t)(front << 1 | 0xE0)));
    }
}

TEST(the_count_is_the_number_of_triggered_sensors)
{
    static const uint8_t counts[8] = {0, 1, 1, 2, 1, 2, 2, 3};

    for (uint8_t pattern = 0; pattern < 8; pattern++)
        TEST_ASSERT_EQUAL_UINT8(counts[pattern], pattern_count(pattern));
}
