#include "pins_rig.h"

#include "tests/test.h"

TEST(senses_come_every_four_beats_with_the_next_tick)
{
    uint8_t tick = sense()->tick;
    unsigned beats = pins.beats;

    TEST_ASSERT_EQUAL_UINT8(tick + 1, sense()->tick);
    TEST_ASSERT_EQUAL_UINT(BEATS, pins.beats - beats);
    TEST_ASSERT_EQUAL_UINT8(telemetry.sent.tick, in.senses.tick);
}

/* Returns after how many beats from an order on the next senses come; it comes two beats before they would have. */
static unsigned beats_after_an_order(void)
{
    unsigned beats;

    (void)sense();
    telemetry.in = (struct input){.command = {.opcode = OPCODE_SET}};
    telemetry.next = INPUT_COMMAND;
    telemetry.from_beat = pins.beats + BEATS - 2;
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    beats = pins.beats;
    TEST_ASSERT_EQUAL_UINT(telemetry.from_beat, beats);
    (void)sense();
    return pins.beats - beats;
}

TEST(tick_begins_with_an_order_only_at_rest)
{
    TEST_ASSERT_EQUAL_UINT(BEATS, beats_after_an_order());
    drive(0, 100);
    TEST_ASSERT_EQUAL_UINT(2, beats_after_an_order());
    drive(100, 0);
    TEST_ASSERT_EQUAL_UINT(2, beats_after_an_order());
}

TEST(sensors_detect_a_wall_but_not_ambient_light)
{
    pins.ambient = MOST;
    (void)sense();
    TEST_ASSERT_EQUAL_HEX8(0, sense()->feel);
    pins.ambient = 100;
    pins.light = 1300;
    (void)sense();
    TEST_ASSERT_EQUAL_HEX8(31, sense()->feel);
    TEST_ASSERT_EQUAL_UINT8(RANGE_NONE, in.senses.range_mm[2]);
    telemetry.wants_ranges = true;
    TEST_ASSERT_LESS_THAN_UINT8(RANGE_NONE, sense()->range_mm[2]);
}

TEST(leds_are_off_when_senses_are_returned)
{
    unsigned shone = 0, before = pins.beats;

    for (unsigned i = 0; i < 10; i++) {
        (void)sense();
        shone += pins.shines;
    }
    TEST_ASSERT_EQUAL_UINT(0, shone);
    TEST_ASSERT_EQUAL_UINT(10 * BEATS, pins.beats - before);
}

TEST(four_bursts_are_food_and_eight_are_food_in_reach)
{
    TEST_ASSERT_FALSE(sense()->look);
    pins.bursts = 2;
    TEST_ASSERT_FALSE(sense()->look);
    pins.bursts += 4;
    TEST_ASSERT_TRUE(sense()->look);
    TEST_ASSERT_EQUAL_UINT16(1000, in.senses.beacon_mm);
    pins.bursts += 8;
    TEST_ASSERT_TRUE(sense()->look);
    TEST_ASSERT_EQUAL_UINT16(100, in.senses.beacon_mm);
    TEST_ASSERT_FALSE(sense()->look);
    TEST_ASSERT_EQUAL_UINT16(0, in.senses.beacon_mm);
}

TEST(drive_powers_the_wheels_and_odometers_report_counts)
{
    uint16_t before = sense()->odometer_left;

    drive(200, -200);
    (void)sense();
    TEST_ASSERT_TRUE(pins.awake);
    TEST_ASSERT_TRUE(pins.duty[0] > 5000 && pins.duty[1] < -5000);
    pins.counts[0] = (uint16_t)(pins.counts[0] + 100);
    TEST_ASSERT_EQUAL_UINT16((before + 91) % 4096, sense()->odometer_left);
    drive(0, 0);
}

TEST(bump_cancels_the_drive_until_the_next_one)
{
    for (unsigned i = 0; i < 5; i++) {
        drive(200, 200);
        (void)sense();
    }
    pins.bumped = true;
    TEST_ASSERT_TRUE(sense()->bump);
    run_ticks(20);
    TEST_ASSERT_TRUE(pins.duty[0] < 5000);
    drive(-100, -100);
    run_ticks(5);
    TEST_ASSERT_TRUE(pins.duty[0] < -5000);
    drive(0, 0);
}

TEST(stop_discards_the_wheel_backlog)
{
    const struct output stop = {.has_drive = true, .drive = {.reason = REASON_STOP}};

    for (unsigned i = 0; i < 10; i++) {
        drive(200, 200);
        (void)sense();
    }
    TEST_ASSERT_TRUE(pins.duty[0] > 5000);
    (void)hal_send(hal, &stop);
    (void)sense();
    TEST_ASSERT_EQUAL_INT32(0, pins.duty[0]);
}

TEST(command_precedes_senses_and_marks_its_output_as_asked)
{
    const struct output out = {.has_answer = true};

    telemetry.in.command.opcode = OPCODE_FREEZE;
    telemetry.next = INPUT_COMMAND;
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    TEST_ASSERT_EQUAL_INT(OPCODE_FREEZE, in.command.opcode);
    (void)hal_send(hal, &out);
    TEST_ASSERT_TRUE(telemetry.asked);
    (void)sense();
    (void)hal_send(hal, &out);
    TEST_ASSERT_FALSE(telemetry.asked);
}

TEST(button_start_uses_an_entropy_seed)
{
    const struct output rests = {.report.running = false};

    (void)hal_send(hal, &rests);
    TEST_ASSERT_EQUAL_INT(OPCODE_START, opcode_after_press_within(70));
    TEST_ASSERT_EQUAL_UINT32(1000, in.command.value);
}

TEST(turning_wheel_postpones_store_and_button_stops_it)
{
    const uint8_t memory[CELL_COUNT] = {0};

    port.result = PORT_LATER;
    drive(0, 200);
    TEST_ASSERT_EQUAL_INT(0, hal_store(hal, memory, false));
    drive(0, 200);
    TEST_ASSERT_EQUAL_UINT(1, port.stores);
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, opcode_after_press_within(10));
    drive(0, 0);
}

TEST(ambient_light_changes_the_entropy)
{
    uint32_t before = hal_entropy(hal);

    pins.ambient = 5;
    (void)sense();
    TEST_ASSERT_TRUE(before != hal_entropy(hal));
}

TEST(store_that_needs_an_erase_waits_for_rest)
{
    const uint8_t memory[CELL_COUNT] = {0, 1, 2};

    port.result = PORT_LATER;
    drive(200, 200);
    TEST_ASSERT_EQUAL_INT(0, hal_store(hal, memory, false));
    drive(200, 200);
    TEST_ASSERT_EQUAL_UINT(1, port.stores);
    drive(0, 0);
    TEST_ASSERT_EQUAL_UINT(2, port.stores);
    TEST_ASSERT_EQUAL_INT(PORT_AT_REST, port.effort);
    TEST_ASSERT_EQUAL_UINT8(2, port.memory[2]);
    drive(0, 0);
    TEST_ASSERT_EQUAL_UINT(2, port.stores);
}

TEST(motors_are_off_while_a_page_may_be_erased)
{
    const uint8_t memory[CELL_COUNT] = {0};

    port.result = PORT_LATER;
    drive(200, 200);
    (void)sense();
    TEST_ASSERT_EQUAL_INT(0, hal_store(hal, memory, false));
    TEST_ASSERT_TRUE(port.pushed);
    drive(0, 0);
    TEST_ASSERT_EQUAL_UINT(2, port.stores);
    TEST_ASSERT_FALSE(port.pushed);
    drive(200, 200);
    (void)sense();
    TEST_ASSERT_EQUAL_INT(0, hal_store(hal, memory, true));
    TEST_ASSERT_FALSE(port.pushed);
    drive(0, 0);
}

TEST(postponed_and_failed_stores_reach_telemetry)
{
    const uint8_t memory[CELL_COUNT] = {0};
    uint8_t loaded[CELL_COUNT];

    port.result = PORT_LATER;
    drive(200, 200);
    (void)hal_store(hal, memory, false);
    TEST_ASSERT_EQUAL_INT(PORT_LATER, telemetry.stored);
    drive(0, 0);
    TEST_ASSERT_EQUAL_INT(0, telemetry.stored);
    port.result = HAL_E_STORE;
    (void)hal_store(hal, memory, false);
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, telemetry.stored);
    telemetry.stored = 0;
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, hal_load(hal, loaded));
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, telemetry.stored);
}

/* Each command at rest delays the next tick. */
TEST(successive_commands_do_not_starve_the_watchdog)
{
    for (unsigned i = 0; i < 20; i++) {
        telemetry.next = INPUT_COMMAND;
        telemetry.from_beat = pins.beats + BEATS - 1;
        TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    }
    TEST_ASSERT_GREATER_OR_EQUAL_UINT(20, port.alive);
}

TEST(store_and_open_errors_are_returned)
{
    const uint8_t memory[CELL_COUNT] = {0};
    uint8_t loaded[CELL_COUNT];

    port.result = HAL_E_STORE;
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, hal_store(hal, memory, false));
    TEST_ASSERT_EQUAL_INT(0, hal_store(hal, memory, true));
    port.result = 0;
    TEST_ASSERT_EQUAL_INT(1, hal_load(hal, loaded));
    TEST_ASSERT_EQUAL_INT(HAL_E_USAGE, hal_open(&hal, -1, NULL));
    telemetry.opens = HAL_E_BODY;
    TEST_ASSERT_EQUAL_INT(HAL_E_BODY, hal_open(&hal, 0, NULL));
}

TEST(start_by_button_sets_the_measured_track)
{
    send_rest(false);
    TEST_ASSERT_EQUAL_INT(OPCODE_START, opcode_after_press_within(70));
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    TEST_ASSERT_EQUAL_INT(OPCODE_SET, in.command.opcode);
    TEST_ASSERT_EQUAL_UINT8(WHEEL_TRACK_MM, in.command.which);
    TEST_ASSERT_EQUAL_UINT32(160, in.command.value);
    (void)sense();
}

/* Last: it holds until a reset. */
TEST(empty_battery_stops_the_wheels_until_reset)
{
    drive(200, 200);
    (void)sense();
    TEST_ASSERT_FALSE(port.outage);
    pins.battery_mv = 5000;
    run_ticks(11);
    TEST_ASSERT_FALSE(pins.awake);
    TEST_ASSERT_EQUAL_INT32(0, pins.duty[0]);
    TEST_ASSERT_TRUE(port.outage);
    pins.battery_mv = GOOD_MV;
    drive(200, 200);
    (void)sense();
    TEST_ASSERT_EQUAL_INT32(0, pins.duty[0]);
}
