/* A robot of its own that measures its light, its motors and its track. */
#include "pins_rig.h"

#include "tests/test.h"

/* A command from outside for a parameter of the body, and the answer to it. */
static uint32_t told_by_the_body(enum opcode opcode, uint8_t which, uint32_t value)
{
    const struct output refused = {.has_answer = true, .answer = RESULT_UNKNOWN_PARAMETER};

    told.in.command = (struct command){opcode, which, value};
    told.next = INPUT_COMMAND;
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    (void)hal_send(hal, &refused);
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, told.out.answer);
    return told.out.answer_value;
}

static void measure_light(uint16_t light)
{
    pins.light = light;
    (void)told_by_the_body(OPCODE_SET, BODY_MEASURE, 1);
    for (unsigned i = 0; i < 30; i++) {
        (void)sense();
        rest_with(false);
    }
    TEST_ASSERT_EQUAL_UINT32(0, told_by_the_body(OPCODE_GET, BODY_MEASURE, 0));
}

TEST(no_motor_is_pushed_while_what_was_measured_is_stored)
{
    pins.light = 1600;
    (void)told_by_the_body(OPCODE_SET, BODY_MEASURE, 1);
    for (unsigned i = 0; i < 30; i++) {
        pins.counts[0] = (uint16_t)(i % 2 * 40);   /* somebody shakes it, and its wheel resists */
        (void)sense();
        rest_with(false);
    }
    TEST_ASSERT_EQUAL_UINT(3, port.more);
    TEST_ASSERT_FALSE(port.pushed);
}

TEST(no_motor_is_pushed_while_what_was_set_is_stored)
{
    pins.counts[0] = 40;   /* somebody pushes it, and its wheel resists for a beat */
    told.from_beat = pins.beats + 1;
    (void)told_by_the_body(OPCODE_SET, BODY_LAG_MS, 61);
    TEST_ASSERT_EQUAL_UINT(3, port.more);
    TEST_ASSERT_FALSE(port.pushed);
}

TEST(a_command_does_not_let_go_of_a_robot_that_drives)
{
    drive(200, 200);
    (void)sense();
    (void)told_by_the_body(OPCODE_GET, BODY_LAG_MS, 0);
    TEST_ASSERT_GREATER_THAN_INT32(0, pins.duty[0]);
    rest_with(false);
}

TEST(a_sensor_is_triggered_by_the_light_that_was_measured_and_that_is_stored)
{
    measure_light(1600);
    TEST_ASSERT_EQUAL_UINT(3, port.more);
    TEST_ASSERT_EQUAL_UINT32(100, told_by_the_body(OPCODE_GET, BODY_NEAR_FRONT, 0));
    pins.light = 1300;
    stay(2);
    TEST_ASSERT_EQUAL_HEX8(0, sense()->feel);
    pins.light = 1600;
    (void)sense();
    TEST_ASSERT_EQUAL_HEX8(31, sense()->feel);
}

TEST(light_that_cannot_be_is_refused_and_the_led_says_so)
{
    measure_light(100);
    TEST_ASSERT_EQUAL_UINT(0, port.more);
    TEST_ASSERT_EQUAL_UINT32(6 << 8 | BODY_NEAR_RIGHT, told_by_the_body(OPCODE_GET, BODY_REFUSED, 0));
    (void)sense();
    TEST_ASSERT_TRUE(port.outage);
}

enum { REST = 25 };   /* ticks, with which a measurement of the motors begins */

TEST(motors_are_pushed_as_they_are_measured_and_a_bump_ends_it)
{
    (void)told_by_the_body(OPCODE_SET, BODY_MEASURE, 2);
    stay(REST + 1);
    (void)told_by_the_body(OPCODE_GET, BODY_MEASURE, 0);
    TEST_ASSERT_EQUAL_INT32(16384, pins.duty[0]);
    TEST_ASSERT_EQUAL_INT32(16384, pins.duty[1]);
    pins.bumped = true;
    (void)sense();
    TEST_ASSERT_EQUAL_INT32(0, pins.duty[0]);
    TEST_ASSERT_EQUAL_UINT32(BODY_MEASURE, told_by_the_body(OPCODE_GET, BODY_REFUSED, 0));
}

TEST(what_takes_an_erase_waits_for_the_end_of_a_measurement)
{
    const uint8_t memory[CELL_COUNT] = {0};

    (void)told_by_the_body(OPCODE_SET, BODY_MEASURE, 2);
    stay(2);
    port.result = PORT_LATER;
    TEST_ASSERT_EQUAL_INT(0, hal_store(hal, memory, true));
    TEST_ASSERT_EQUAL_INT(PORT_QUICKLY, port.effort);
    (void)told_by_the_body(OPCODE_SET, BODY_MEASURE, 0);
    (void)sense();
    rest_with(false);
    TEST_ASSERT_EQUAL_INT(PORT_AT_REST, port.effort);
}

TEST(it_turns_on_the_spot_to_measure_its_track_until_the_robot_is_started)
{
    (void)told_by_the_body(OPCODE_SET, BODY_MEASURE, 3);
    for (unsigned i = 0; i < 5; i++) {
        (void)sense();
        rest_with(false);
    }
    TEST_ASSERT_TRUE(pins.duty[0] > 5000 && pins.duty[1] < -5000);
    rest_with(true);
    (void)sense();
    TEST_ASSERT_EQUAL_INT32(0, pins.duty[0]);
    TEST_ASSERT_EQUAL_UINT32(BODY_MEASURE, told_by_the_body(OPCODE_GET, BODY_REFUSED, 0));
}

/* The button is pressed so often, and let go. */
static void press(unsigned times)
{
    for (unsigned i = 0; i < 20 * times; i++) {
        pins.pressed = i % 20 < 10;
        (void)hal_receive(hal, &in);
        rest_with(false);
    }
}

TEST(a_button_pressed_at_power_up_measures_instead_of_starting_as_often_as_it_is_pressed)
{
    pins.pressed = true;
    TEST_ASSERT_EQUAL_INT(0, hal_open(&hal, 0, NULL));
    press(2);
    for (unsigned i = 0; i < 45; i++) {
        TEST_ASSERT_EQUAL_INT(INPUT_SENSES, hal_receive(hal, &in));
        rest_with(false);
    }
    TEST_ASSERT_EQUAL_UINT32(2, told_by_the_body(OPCODE_GET, BODY_MEASURE, 0));
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, told_by_a_press_within(10));
    TEST_ASSERT_EQUAL_UINT32(0, told_by_the_body(OPCODE_GET, BODY_MEASURE, 0));
    press(4);
    for (unsigned i = 0; i < 60; i++)
        TEST_ASSERT_EQUAL_INT(INPUT_SENSES, hal_receive(hal, &in));
    TEST_ASSERT_EQUAL_UINT32(0, told_by_the_body(OPCODE_GET, BODY_MEASURE, 0));
}
