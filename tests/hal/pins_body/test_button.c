#include "tests/test.h"
#include "hal/pins_body/inputs.h"
#include "hal/pins_body/guard.h"

enum { SECOND = 50, PRESS = 10 };   /* ticks */

static struct button button;
static struct command last_command;
static unsigned command_count;
static bool running;

BEFORE_EACH(button)
{
    button = (struct button){.down = false};
    command_count = 0;
    running = false;
}

static void look(bool pressed, unsigned ticks)
{
    for (unsigned i = 0; i < ticks; i++)
        command_count += button_look(&button, pressed, running, &last_command);
}

static void press(unsigned ticks)
{
    look(true, ticks);
    look(false, PRESS);
}

TEST(single_press_starts_the_first_profile_after_1_s)
{
    press(PRESS);
    look(false, SECOND - PRESS - 1);
    TEST_ASSERT_EQUAL_UINT(0, command_count);
    look(false, PRESS);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
    TEST_ASSERT_EQUAL_INT(OPCODE_START, last_command.opcode);
    TEST_ASSERT_EQUAL_UINT8(0, last_command.which);
    look(false, 10 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
}

TEST(number_of_presses_selects_the_profile)
{
    for (unsigned i = 0; i < 3; i++)
        press(PRESS);
    look(false, SECOND);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
    TEST_ASSERT_EQUAL_UINT8(2, last_command.which);
}

TEST(profile_number_wraps_after_the_last)
{
    for (unsigned i = 0; i < PROFILE_COUNT + 1; i++)
        press(PRESS);
    look(false, SECOND);
    TEST_ASSERT_EQUAL_UINT8(0, last_command.which);
}

TEST(button_release_stops_a_running_robot)
{
    running = true;
    press(PRESS);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, last_command.opcode);
    running = false;
    look(false, 10 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
}

TEST(button_held_for_five_seconds_erases_and_starts_nothing)
{
    look(true, 5 * SECOND + 2);
    TEST_ASSERT_EQUAL_UINT(0, command_count);
    look(true, 1);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
    TEST_ASSERT_EQUAL_INT(OPCODE_ERASE, last_command.opcode);
    look(true, 10 * SECOND);
    look(false, 10 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
}

TEST(button_held_while_running_erases_and_keeps_running)
{
    running = true;
    press(6 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
    TEST_ASSERT_EQUAL_INT(OPCODE_ERASE, last_command.opcode);
}

TEST(bouncing_contacts_are_no_press)
{
    for (unsigned i = 0; i < SECOND; i++) {
        look(true, 2);
        look(false, 1);
    }
    look(false, 2 * SECOND);
    TEST_ASSERT_EQUAL_UINT(0, command_count);
}

TEST(start_comes_1_s_after_the_debounced_release)
{
    look(true, PRESS);
    look(false, 3 + SECOND - 1);
    TEST_ASSERT_EQUAL_UINT(0, command_count);
    look(false, 1);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
}

TEST(second_press_delays_the_start)
{
    press(PRESS);
    look(true, 2 * SECOND);
    TEST_ASSERT_EQUAL_UINT(0, command_count);
}

TEST(bounce_after_a_press_is_no_second_press)
{
    look(true, 3);
    look(false, 2);
    look(true, PRESS);
    look(false, 2 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
    TEST_ASSERT_EQUAL_UINT8(0, last_command.which);
}

TEST(stop_discards_earlier_presses)
{
    press(PRESS);
    running = true;
    press(PRESS);
    running = false;
    look(false, 2 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, last_command.opcode);
    TEST_ASSERT_EQUAL_UINT8(0, last_command.which);
}

TEST(button_starts_the_robot_after_an_erase)
{
    press(6 * SECOND);
    TEST_ASSERT_EQUAL_UINT8(0, last_command.which);
    TEST_ASSERT_EQUAL_UINT16(PRESS - 3, button.ticks);
    press(PRESS);
    look(false, SECOND);
    TEST_ASSERT_EQUAL_UINT(2, command_count);
    TEST_ASSERT_EQUAL_INT(OPCODE_START, last_command.opcode);
}

TEST(hold_time_saturates_at_5_s)
{
    look(true, 400 * SECOND);
    TEST_ASSERT_EQUAL_UINT16(5 * SECOND, button.ticks);
    TEST_ASSERT_EQUAL_UINT(1, command_count);
}

enum { GOOD_MV = 7200, HARD = 30000 };

static struct guard guard;
static struct guard_look now;

BEFORE_EACH(guard)
{
    guard = (struct guard){.known = false};
    now = (struct guard_look){.battery_mv = GOOD_MV};
}

/* Beats in each of which the left wheel moves by count; true if the last of them stops the wheels. */
static bool stops_after(unsigned looks, int count)
{
    bool stops = false;

    for (unsigned i = 0; i < looks; i++) {
        now.counts[0] = (uint16_t)(now.counts[0] + count);
        stops = guard_stops(&guard, &now);
    }
    return stops;
}

TEST(wheel_guard_accepts_a_wheel_that_follows_its_duty)
{
    guard.duty[0] = HARD;
    TEST_ASSERT_FALSE(stops_after(1000, 10));
    guard.duty[0] = -HARD;
    TEST_ASSERT_FALSE(stops_after(1000, -10));
    guard.duty[0] = 0;
    TEST_ASSERT_FALSE(stops_after(1000, -10));
    TEST_ASSERT_FALSE(guard_forbids(&guard));
}

TEST(wheel_guard_detects_a_reversed_encoder_within_200_ms)
{
    TEST_ASSERT_FALSE(stops_after(1, 0));
    guard.duty[0] = HARD;
    TEST_ASSERT_FALSE(stops_after(GUARD_BEATS - 1, -10));
    TEST_ASSERT_TRUE(stops_after(1, -10));
    TEST_ASSERT_TRUE(guard_forbids(&guard));
    TEST_ASSERT_TRUE(stops_after(1, 10));
}

TEST(wheel_guard_tolerates_a_reversing_motor)
{
    TEST_ASSERT_FALSE(stops_after(1, 0));
    guard.duty[0] = -HARD;
    TEST_ASSERT_FALSE(stops_after(GUARD_BEATS - 1, 10));
    TEST_ASSERT_FALSE(stops_after(1, -1));
    TEST_ASSERT_FALSE(stops_after(GUARD_BEATS - 1, 10));
    TEST_ASSERT_FALSE(guard_forbids(&guard));
}

TEST(wheel_guard_ignores_encoder_at_low_duty)
{
    guard.duty[0] = GUARD_WRONG_DUTY;
    TEST_ASSERT_FALSE(stops_after(1000, -10));
    guard.duty[0] = -GUARD_WRONG_DUTY;
    TEST_ASSERT_FALSE(stops_after(1000, 10));
}

TEST(bump_stops_the_wheels_once)
{
    now.bumped = true;
    TEST_ASSERT_TRUE(stops_after(1, 0));
    TEST_ASSERT_FALSE(stops_after(10, 0));
    now.bumped = false;
    TEST_ASSERT_FALSE(stops_after(1, 0));
    now.bumped = true;
    TEST_ASSERT_TRUE(stops_after(1, 0));
    TEST_ASSERT_FALSE(guard_forbids(&guard));
}

TEST(empty_battery_stops_the_wheels_but_a_dip_does_not)
{
    now.battery_mv = GUARD_BATTERY_MV - 1;
    TEST_ASSERT_FALSE(stops_after(GUARD_BEATS - 1, 0));
    now.battery_mv = GUARD_BATTERY_MV;
    TEST_ASSERT_FALSE(stops_after(1, 0));
    now.battery_mv = GUARD_BATTERY_MV - 1;
    TEST_ASSERT_FALSE(stops_after(GUARD_BEATS - 1, 0));
    TEST_ASSERT_TRUE(stops_after(1, 0));
    now.battery_mv = GOOD_MV;
    TEST_ASSERT_TRUE(stops_after(1, 0));
}

TEST(bridge_failure_stops_the_wheels_for_good)
{
    now.failed = true;
    TEST_ASSERT_TRUE(stops_after(1, 0));
    now.failed = false;
    TEST_ASSERT_TRUE(guard_forbids(&guard));
}

TEST(wheel_guard_watches_the_right_wheel)
{
    guard.duty[1] = HARD;
    for (unsigned i = 0; i <= GUARD_BEATS; i++) {
        now.counts[1] = (uint16_t)(now.counts[1] - 10);
        (void)guard_stops(&guard, &now);
    }
    TEST_ASSERT_TRUE(guard_forbids(&guard));
}

enum { AMBIENT = 300, NEAR = 1200 };

static struct proximity proximity;

BEFORE_EACH(proximity)
{
    proximity = (struct proximity){.near = {NEAR, NEAR, NEAR, NEAR, NEAR}};
}

/* All sensors receive this much of their own light, in this ambient light. */
static uint8_t feel(unsigned back, unsigned ambient)
{
    uint16_t dark[FEEL_COUNT];

    for (unsigned i = 0; i < FEEL_COUNT; i++) {
        dark[i] = (uint16_t)ambient;
        proximity.lit[i] = (uint16_t)(ambient + back);
    }
    return proximity_feel(&proximity, dark);
}

TEST(sensor_triggers_at_its_light_threshold)
{
    TEST_ASSERT_EQUAL_HEX8(0, feel(NEAR - 1, AMBIENT));
    TEST_ASSERT_EQUAL_HEX8(31, feel(NEAR, AMBIENT));
}

TEST(ambient_light_is_subtracted)
{
    TEST_ASSERT_EQUAL_HEX8(0, feel(0, 4095));
    TEST_ASSERT_EQUAL_HEX8(31, feel(NEAR, 2000));
}

TEST(sensor_releases_10_percent_below_its_threshold)
{
    (void)feel(NEAR, AMBIENT);
    TEST_ASSERT_EQUAL_HEX8(31, feel(NEAR * 9 / 10, AMBIENT));
    TEST_ASSERT_EQUAL_HEX8(0, feel(NEAR * 9 / 10 - 1, AMBIENT));
    TEST_ASSERT_EQUAL_HEX8(0, feel(NEAR - 1, AMBIENT));
}

TEST(falling_ambient_light_triggers_no_sensor)
{
    uint16_t dark[FEEL_COUNT] = {4000, 4000, 4000, 4000, 4000};

    (void)feel(0, AMBIENT);
    TEST_ASSERT_EQUAL_HEX8(0, proximity_feel(&proximity, dark));
}

TEST(sensors_have_their_own_bits_and_thresholds)
{
    uint16_t dark[FEEL_COUNT] = {0};

    (void)feel(0, 0);
    proximity.lit[1] = 700;
    proximity.near[1] = 700;
    proximity.lit[4] = NEAR;
    TEST_ASSERT_EQUAL_HEX8(FEEL_FRONT_RIGHT | FEEL_LEFT, proximity_feel(&proximity, dark));
}

TEST(range_follows_from_reflected_light)
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
