#include "pins_rig.h"

#include "tests/test.h"

TEST(senses_come_every_four_beats_with_the_next_tick)
{
    uint8_t tick = sense()->tick;
    unsigned beats = pins.beats;

    TEST_ASSERT_EQUAL_UINT8(tick + 1, sense()->tick);
    TEST_ASSERT_EQUAL_UINT(BEATS, pins.beats - beats);
    TEST_ASSERT_EQUAL_UINT8(told.said.tick, in.senses.tick);
}

/* Returns after how many beats from an order on the next senses come; it comes two beats before they would have. */
static unsigned beats_after_an_order(void)
{
    unsigned beats;

    (void)sense();
    told.in = (struct input){.command = {.opcode = OPCODE_SET}};
    told.next = INPUT_COMMAND;
    told.from_beat = pins.beats + BEATS - 2;
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    beats = pins.beats;
    TEST_ASSERT_EQUAL_UINT(told.from_beat, beats);
    (void)sense();
    return pins.beats - beats;
}

TEST(at_rest_the_next_tick_begins_with_an_order_and_under_way_no_tick_waits_for_one)
{
    TEST_ASSERT_EQUAL_UINT(BEATS, beats_after_an_order());
    drive(0, 100);
    TEST_ASSERT_EQUAL_UINT(2, beats_after_an_order());
    drive(100, 0);
    TEST_ASSERT_EQUAL_UINT(2, beats_after_an_order());
}

TEST(a_wall_is_felt_and_light_of_the_room_is_not)
{
    pins.ambient = MOST;
    (void)sense();
    TEST_ASSERT_EQUAL_HEX8(0, sense()->feel);
    pins.ambient = 100;
    pins.light = 1300;
    (void)sense();
    TEST_ASSERT_EQUAL_HEX8(31, sense()->feel);
    TEST_ASSERT_EQUAL_UINT8(RANGE_NONE, in.senses.range_mm[2]);
    told.wants_ranges = true;
    TEST_ASSERT_LESS_THAN_UINT8(RANGE_NONE, sense()->range_mm[2]);
}

TEST(the_leds_shine_for_one_beat_of_a_tick)
{
    unsigned shone = 0, before = pins.beats;

    for (unsigned i = 0; i < 10; i++) {
        (void)sense();
        shone += pins.shines;
    }
    TEST_ASSERT_EQUAL_UINT(0, shone);   /* dark when all is known */
    TEST_ASSERT_EQUAL_UINT(10 * BEATS, pins.beats - before);
}

TEST(four_bursts_in_a_tick_are_food_and_eight_are_food_in_reach)
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

TEST(wheels_are_pushed_as_told_and_their_ways_are_told)
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

TEST(a_bump_takes_back_what_was_told_and_the_next_order_counts)
{
    for (unsigned i = 0; i < 5; i++) {
        drive(200, 200);
        (void)sense();
    }
    pins.bumped = true;
    TEST_ASSERT_TRUE(sense()->bump);
    stay(20);
    TEST_ASSERT_TRUE(pins.duty[0] < 5000);
    drive(-100, -100);
    stay(5);
    TEST_ASSERT_TRUE(pins.duty[0] < -5000);
    drive(0, 0);
}

TEST(a_stopped_robot_does_not_make_up_for_what_its_wheels_missed)
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

TEST(a_command_from_outside_comes_before_the_senses_and_its_answer_was_asked_for)
{
    const struct output out = {.has_answer = true};

    told.in.command.opcode = OPCODE_FREEZE;
    told.next = INPUT_COMMAND;
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    TEST_ASSERT_EQUAL_INT(OPCODE_FREEZE, in.command.opcode);
    (void)hal_send(hal, &out);
    TEST_ASSERT_TRUE(told.asked);
    (void)sense();
    (void)hal_send(hal, &out);
    TEST_ASSERT_FALSE(told.asked);
}

TEST(the_button_starts_with_a_seed_of_its_own)
{
    const struct output rests = {.report.running = false};

    (void)hal_send(hal, &rests);
    TEST_ASSERT_EQUAL_INT(OPCODE_START, told_by_a_press_within(70));
    TEST_ASSERT_EQUAL_UINT32(1000, in.command.value);
}

TEST(the_button_stops_a_robot_that_runs_and_a_wheel_that_turns_is_no_rest)
{
    const uint8_t memory[CELL_COUNT] = {0};

    port.result = PORT_LATER;
    drive(0, 200);
    TEST_ASSERT_EQUAL_INT(0, hal_store(hal, memory, false));
    drive(0, 200);
    TEST_ASSERT_EQUAL_UINT(1, port.stores);
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, told_by_a_press_within(10));
    drive(0, 0);
}

TEST(light_makes_a_seed_another_one)
{
    uint32_t before = hal_entropy(hal);

    pins.ambient = 5;
    (void)sense();
    TEST_ASSERT_TRUE(before != hal_entropy(hal));
}

TEST(what_takes_an_erase_is_stored_when_the_wheels_rest)
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

TEST(no_motor_is_pushed_while_a_page_may_be_erased)
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

TEST(what_was_put_off_or_could_not_be_stored_or_loaded_is_said)
{
    const uint8_t memory[CELL_COUNT] = {0};
    uint8_t loaded[CELL_COUNT];

    port.result = PORT_LATER;
    drive(200, 200);
    (void)hal_store(hal, memory, false);
    TEST_ASSERT_EQUAL_INT(PORT_LATER, told.stored);
    drive(0, 0);
    TEST_ASSERT_EQUAL_INT(0, told.stored);
    port.result = HAL_E_STORE;
    (void)hal_store(hal, memory, false);
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, told.stored);
    told.stored = 0;
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, hal_load(hal, loaded));
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, told.stored);
}

/* Each order at rest puts off the next tick. */
TEST(orders_that_follow_one_another_do_not_starve_the_watchdog)
{
    for (unsigned i = 0; i < 20; i++) {
        told.next = INPUT_COMMAND;
        told.from_beat = pins.beats + BEATS - 1;
        TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    }
    TEST_ASSERT_GREATER_OR_EQUAL_UINT(20, port.alive);
}

TEST(what_cannot_be_stored_or_opened_is_said)
{
    const uint8_t memory[CELL_COUNT] = {0};
    uint8_t loaded[CELL_COUNT];

    port.result = HAL_E_STORE;
    TEST_ASSERT_EQUAL_INT(HAL_E_STORE, hal_store(hal, memory, false));
    TEST_ASSERT_EQUAL_INT(0, hal_store(hal, memory, true));
    port.result = 0;
    TEST_ASSERT_EQUAL_INT(1, hal_load(hal, loaded));
    TEST_ASSERT_EQUAL_INT(HAL_E_USAGE, hal_open(&hal, -1, NULL));
    told.opens = HAL_E_BODY;
    TEST_ASSERT_EQUAL_INT(HAL_E_BODY, hal_open(&hal, 0, NULL));
}

TEST(a_robot_that_the_button_starts_is_told_its_track)
{
    rest_with(false);
    TEST_ASSERT_EQUAL_INT(OPCODE_START, told_by_a_press_within(70));
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, hal_receive(hal, &in));
    TEST_ASSERT_EQUAL_INT(OPCODE_SET, in.command.opcode);
    TEST_ASSERT_EQUAL_UINT8(WHEEL_TRACK_MM, in.command.which);
    TEST_ASSERT_EQUAL_UINT32(160, in.command.value);
    (void)sense();
}

/* Last: it holds until a reset. */
TEST(z_wheels_of_a_robot_with_an_empty_battery_rest_for_good)
{
    drive(200, 200);
    (void)sense();
    TEST_ASSERT_FALSE(port.outage);
    pins.battery_mv = 5000;
    stay(11);
    TEST_ASSERT_FALSE(pins.awake);
    TEST_ASSERT_EQUAL_INT32(0, pins.duty[0]);
    TEST_ASSERT_TRUE(port.outage);
    pins.battery_mv = GOOD_MV;
    drive(200, 200);
    (void)sense();
    TEST_ASSERT_EQUAL_INT32(0, pins.duty[0]);
}
