/* A body that measures its light, its motors and its track. */
#include "pins_rig.h"

#include "tests/test.h"

/* A command from outside for a parameter of the body, and the answer to it. */
static uint32_t body_command(enum opcode opcode, uint8_t which, uint32_t value)
{
    const struct output refused = {.has_answer = true, .answer = RESULT_UNKNOWN_PARAMETER};

    telemetry.in.command = (struct command){opcode, which, value};
    telemetry.next = INPUT_COMMAND;
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    (void)hal_send(hal, &refused);
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, telemetry.out.answer);
    return telemetry.out.answer_value;
}

static void measure_light(uint16_t light)
{
    pins.light = light;
    (void)body_command(OPCODE_SET, BODY_MEASURE, 1);
    for (unsigned i = 0; i < 30; i++) {
        (void)sense();
        send_rest(false);
    }
    TEST_ASSERT_EQUAL_UINT32(0, body_command(OPCODE_GET, BODY_MEASURE, 0));
}

TEST(motors_are_off_while_measured_values_are_stored)
{
    pins.light = 1600;
    (void)body_command(OPCODE_SET, BODY_MEASURE, 1);
    for (unsigned i = 0; i < 30; i++) {
        pins.counts[0] = (uint16_t)(i % 2 * 40);   /* somebody shakes it, and its wheel resists */
        (void)sense();
        send_rest(false);
    }
    TEST_ASSERT_EQUAL_UINT(3, port.more);
    TEST_ASSERT_FALSE(port.pushed);
}

TEST(motors_are_off_while_set_values_are_stored)
{
    pins.counts[0] = 40;   /* somebody pushes it, and its wheel resists for a beat */
    telemetry.from_beat = pins.beats + 1;
    (void)body_command(OPCODE_SET, BODY_LAG_MS, 61);
    TEST_ASSERT_EQUAL_UINT(3, port.more);
    TEST_ASSERT_FALSE(port.pushed);
}

TEST(parameter_command_does_not_stop_a_driving_robot)
{
    drive(200, 200);
    (void)sense();
    (void)body_command(OPCODE_GET, BODY_LAG_MS, 0);
    TEST_ASSERT_GREATER_THAN_INT32(0, pins.duty[0]);
    send_rest(false);
}

TEST(measured_light_is_stored_as_the_sensor_threshold)
{
    measure_light(1600);
    TEST_ASSERT_EQUAL_UINT(3, port.more);
    TEST_ASSERT_EQUAL_UINT32(100, body_command(OPCODE_GET, BODY_NEAR_FRONT, 0));
    pins.light = 1300;
    run_ticks(2);
    TEST_ASSERT_EQUAL_HEX8(0, sense()->feel);
    pins.light = 1600;
    (void)sense();
    TEST_ASSERT_EQUAL_HEX8(31, sense()->feel);
}

TEST(implausible_light_is_refused_and_shown_by_the_led)
{
    measure_light(100);
    TEST_ASSERT_EQUAL_UINT(0, port.more);
    TEST_ASSERT_EQUAL_UINT32(6 << 8 | BODY_NEAR_RIGHT, body_command(OPCODE_GET, BODY_REFUSED, 0));
    (void)sense();
    TEST_ASSERT_TRUE(port.outage);
}

enum { REST = 25 };   /* ticks, with which a measurement of the motors begins */

TEST(bump_ends_a_motor_measurement)
{
    (void)body_command(OPCODE_SET, BODY_MEASURE, 2);
    run_ticks(REST + 1);
    (void)body_command(OPCODE_GET, BODY_MEASURE, 0);
    TEST_ASSERT_EQUAL_INT32(16384, pins.duty[0]);
    TEST_ASSERT_EQUAL_INT32(16384, pins.duty[1]);
    pins.bumped = true;
    (void)sense();
    TEST_ASSERT_EQUAL_INT32(0, pins.duty[0]);
    TEST_ASSERT_EQUAL_UINT32(BODY_MEASURE, body_command(OPCODE_GET, BODY_REFUSED, 0));
}

TEST(erasing_store_waits_for_the_end_of_a_measurement)
{
    const uint8_t memory[CELL_COUNT] = {0};

    (void)body_command(OPCODE_SET, BODY_MEASURE, 2);
    run_ticks(2);
    port.result = PORT_LATER;
    TEST_ASSERT_EQUAL_INT(0, hal_store(hal, memory, true));
    TEST_ASSERT_EQUAL_INT(PORT_QUICKLY, port.effort);
    (void)body_command(OPCODE_SET, BODY_MEASURE, 0);
    (void)sense();
    send_rest(false);
    TEST_ASSERT_EQUAL_INT(PORT_AT_REST, port.effort);
}

TEST(start_ends_a_track_measurement)
{
    (void)body_command(OPCODE_SET, BODY_MEASURE, 3);
    for (unsigned i = 0; i < 5; i++) {
        (void)sense();
        send_rest(false);
    }
    TEST_ASSERT_TRUE(pins.duty[0] > 5000 && pins.duty[1] < -5000);
    send_rest(true);
    (void)sense();
    TEST_ASSERT_EQUAL_INT32(0, pins.duty[0]);
    TEST_ASSERT_EQUAL_UINT32(BODY_MEASURE, body_command(OPCODE_GET, BODY_REFUSED, 0));
}

/* Presses and releases the button this many times. */
static void press(unsigned times)
{
    for (unsigned i = 0; i < 20 * times; i++) {
        pins.pressed = i % 20 < 10;
        (void)hal_receive(hal, &in);
        send_rest(false);
    }
}

TEST(button_held_at_power_up_selects_a_measurement)
{
    pins.pressed = true;
    TEST_ASSERT_EQUAL_INT(0, hal_open(&hal, 0, NULL));
    press(2);
    for (unsigned i = 0; i < 45; i++) {
        TEST_ASSERT_EQUAL_INT(INPUT_SENSES, hal_receive(hal, &in));
        send_rest(false);
    }
    TEST_ASSERT_EQUAL_UINT32(2, body_command(OPCODE_GET, BODY_MEASURE, 0));
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, opcode_after_press_within(10));
    TEST_ASSERT_EQUAL_UINT32(0, body_command(OPCODE_GET, BODY_MEASURE, 0));
    press(4);
    for (unsigned i = 0; i < 60; i++)
        TEST_ASSERT_EQUAL_INT(INPUT_SENSES, hal_receive(hal, &in));
    TEST_ASSERT_EQUAL_UINT32(0, body_command(OPCODE_GET, BODY_MEASURE, 0));
}
