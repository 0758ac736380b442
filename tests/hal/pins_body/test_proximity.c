#include "hal/pins_body/proximity.h"
#include "tests/test.h"

enum { AMBIENT = 300, NEAR = 1200 };

static struct proximity proximity;

void setUp(void)
{
    proximity = (struct proximity){.near = {NEAR, NEAR, NEAR, NEAR, NEAR}};
}

/* All sensors receive so much of their own light, in this ambient light. */
static uint8_t feel(unsigned back, unsigned ambient)
{
    uint16_t dark[FEEL_COUNT];

    for (unsigned i = 0; i < FEEL_COUNT; i++) {
        dark[i] = (uint16_t)ambient;
        proximity.lit[i] = (uint16_t)(ambient + back);
    }
    return proximity_feel(&proximity, dark);
}

TEST(a_sensor_is_triggered_by_as_much_light_as_a_near_wall_gives_back)
{
    TEST_ASSERT_EQUAL_HEX8(0, feel(NEAR - 1, AMBIENT));
    TEST_ASSERT_EQUAL_HEX8(31, feel(NEAR, AMBIENT));
}

TEST(light_that_is_there_anyway_does_not_count)
{
    TEST_ASSERT_EQUAL_HEX8(0, feel(0, 4095));
    TEST_ASSERT_EQUAL_HEX8(31, feel(NEAR, 2000));
}

TEST(a_sensor_lets_go_at_a_tenth_less)
{
    (void)feel(NEAR, AMBIENT);
    TEST_ASSERT_EQUAL_HEX8(31, feel(NEAR * 9 / 10, AMBIENT));
    TEST_ASSERT_EQUAL_HEX8(0, feel(NEAR * 9 / 10 - 1, AMBIENT));
    TEST_ASSERT_EQUAL_HEX8(0, feel(NEAR - 1, AMBIENT));
}

TEST(light_that_goes_out_between_two_measurements_triggers_nothing)
{
    uint16_t dark[FEEL_COUNT] = {4000, 4000, 4000, 4000, 4000};

    (void)feel(0, AMBIENT);
    TEST_ASSERT_EQUAL_HEX8(0, proximity_feel(&proximity, dark));
}

TEST(each_sensor_has_its_bit_and_its_own_threshold)
{
    uint16_t dark[FEEL_COUNT] = {0};

    (void)feel(0, 0);
    proximity.lit[1] = 700;
    proximity.near[1] = 700;
    proximity.lit[4] = NEAR;
    TEST_ASSERT_EQUAL_HEX8(FEEL_FRONT_RIGHT | FEEL_LEFT, proximity_feel(&proximity, dark));
}

TEST(distance_is_that_of_a_wall_that_gives_back_so_much_light)
{
    (void)feel(NEAR, AMBIENT);
    TEST_ASSERT_EQUAL_UINT8(60, proximity_range_mm(&proximity, 0));
    (void)feel(NEAR * 9 / 10, AMBIENT);
    TEST_ASSERT_EQUAL_UINT8(64, proximity_range_mm(&proximity, 4));   /* 80 / sqrt(0.9) - 20: 64.3 */
    (void)feel(2700, AMBIENT);
    TEST_ASSERT_EQUAL_UINT8(33, proximity_range_mm(&proximity, 2));   /* 80 x 2 / 3 - 20 */
    (void)feel(4095, 0);
    TEST_ASSERT_EQUAL_UINT8(23, proximity_range_mm(&proximity, 2));
    (void)feel(NEAR / 2, AMBIENT);
    TEST_ASSERT_EQUAL_UINT8(RANGE_NONE, proximity_range_mm(&proximity, 2));
}
