#include "hal/protocol/wire.h"

#include <string.h>

#include <unity.h>

#include "firmware/config.h"
#include "firmware/memory.h"
#include "hal/protocol/crc8.h"
#include "octet.h"

enum { NODE = 1 };

static struct wire wire;
static struct output out;
static struct frame frames[WIRE_FRAMES_MAX];
static uint8_t expected_faults[FAULT_COUNT];   /* after each test: no other fault was counted */

void setUp(void)
{
    wire_init(&wire, NODE);
    out = (struct output){.has_answer = false};
    memset(expected_faults, 0, sizeof expected_faults);
}

void tearDown(void)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected_faults, wire.faults, FAULT_COUNT);
}

static void expect(enum fault fault, uint8_t count)
{
    expected_faults[fault] = count;
}

static size_t write(void)
{
    memset(frames, 0xA5, sizeof frames);   /* whatever was there before */
    return wire_write(&wire, &out, frames);
}

static const struct crash CRASH = {.cause = 5, .count = 13, .values = {0x08000123, [12] = 0xFFFFFFFF}};

static void mark_all(void)
{
    wire.health.crash = &CRASH;
    out.has_answer = out.has_report = out.has_memory = out.has_drive = true;
}

static void test_no_mark_makes_no_frame(void)
{
    TEST_ASSERT_EQUAL_size_t(0, write());
}

static void test_all_marks_make_all_frames_the_drive_last(void)
{
    static const uint32_t ids[WIRE_FRAMES_MAX] = {OCTET_ANSWER_FRAME_ID, OCTET_HEARTBEAT_FRAME_ID, OCTET_HEALTH_FRAME_ID,
                                                  OCTET_CRASH_FRAME_ID, OCTET_FAULTS_FRAME_ID, OCTET_MEMORY_FRAME_ID,
                                                  OCTET_DRIVE_FRAME_ID};

    mark_all();
    TEST_ASSERT_EQUAL_size_t(WIRE_FRAMES_MAX, write());
    for (unsigned i = 0; i < WIRE_FRAMES_MAX; i++)
        TEST_ASSERT_EQUAL_UINT32(ids[i], frames[i].id);
}

static void test_the_last_node_writes_its_own_identifiers(void)
{
    static const uint32_t ids[WIRE_FRAMES_MAX] = {257 + 62, 385 + 62, 513 + 62, 577 + 62, 449 + 62, 321 + 62, 129 + 62};

    wire_init(&wire, NODE_MAX);
    mark_all();
    write();
    for (unsigned i = 0; i < WIRE_FRAMES_MAX; i++)
        TEST_ASSERT_EQUAL_UINT32(ids[i], frames[i].id);
}

static void test_bytes_beyond_the_length_are_zero(void)
{
    out.has_answer = true;
    write();
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_LENGTH, frames[0].len);
    TEST_ASSERT_EACH_EQUAL_UINT8(0, frames[0].data + OCTET_ANSWER_LENGTH, 8 - OCTET_ANSWER_LENGTH);
}

static void test_drive_and_answer_bear_their_crc(void)
{
    out.has_answer = out.has_drive = true;
    write();
    TEST_ASSERT_EQUAL_HEX8(crc8_of_frame(&frames[0]), frames[0].data[0]);
    TEST_ASSERT_EQUAL_HEX8(crc8_of_frame(&frames[1]), frames[1].data[0]);
}

static struct octet_drive_t drive_sent(struct drive drive)
{
    struct octet_drive_t sent;

    out.has_drive = true;
    out.drive = drive;
    write();
    TEST_ASSERT_EQUAL(0, octet_drive_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

static void test_wheel_speeds_keep_sign_and_size(void)
{
    static const int16_t speeds[] = {-2047, -1, 0, 1, 2047};

    for (unsigned i = 0; i < 5; i++) {
        const struct octet_drive_t sent = drive_sent((struct drive){.left_mm_s = speeds[i], .right_mm_s = speeds[4 - i]});

        TEST_ASSERT_EQUAL_INT16(speeds[i], sent.left);
        TEST_ASSERT_EQUAL_INT16(speeds[4 - i], sent.right);
    }
}

static void test_a_drive_arrives_whole(void)
{
    const struct octet_drive_t sent = drive_sent(
        (struct drive){.tick = 4095, .reason = REASON_EAT, .repeat_count = 255, .action = 127, .eat = true});

    TEST_ASSERT_EQUAL_UINT16(4095, sent.tick);
    TEST_ASSERT_EQUAL_UINT8(OCTET_DRIVE_REASON_EAT_CHOICE, sent.reason);
    TEST_ASSERT_EQUAL_UINT8(255, sent.repeat_count);
    TEST_ASSERT_EQUAL_UINT8(127, sent.action);
    TEST_ASSERT_EQUAL_UINT8(OCTET_DRIVE_EAT_EAT_CHOICE, sent.eat);
}

static struct octet_answer_t answer_to(uint8_t opcode, uint8_t counter, enum result result)
{
    const struct octet_command_t command = {.opcode = opcode, .counter = counter};
    struct frame frame = {.id = OCTET_COMMAND_FRAME_ID, .len = OCTET_COMMAND_LENGTH};
    struct octet_answer_t sent;
    struct input in;

    octet_command_pack(frame.data, &command, sizeof frame.data);
    frame.data[0] = crc8_of_frame(&frame);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, wire_read(&wire, &frame, &in));
    out.has_answer = true;
    out.answer = result;
    write();
    TEST_ASSERT_EQUAL(0, octet_answer_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

static void test_an_answer_names_the_command_that_it_answers(void)
{
    const struct octet_answer_t sent = answer_to(OPCODE_FREEZE, 15, RESULT_DONE);

    TEST_ASSERT_EQUAL_UINT8(15, sent.counter);
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_OPCODE_FREEZE_CHOICE, sent.opcode);
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_RESULT_DONE_CHOICE, sent.result);
}

static void test_a_refusal_is_counted_and_says_why(void)
{
    const struct octet_answer_t sent = answer_to(OPCODE_SET, 3, RESULT_OUT_OF_RANGE);

    expect(FAULT_REFUSED, 1);
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_RESULT_OUT_OF_RANGE_CHOICE, sent.result);
}

static struct octet_heartbeat_t heartbeat_sent(void)
{
    struct octet_heartbeat_t sent;

    out.has_report = true;
    TEST_ASSERT_EQUAL_size_t(3, write());
    TEST_ASSERT_EQUAL(0, octet_heartbeat_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

static void test_a_heartbeat_tells_how_the_robot_fares(void)
{
    struct octet_heartbeat_t sent;

    out.report.running = true;
    out.report.uptime_s = 65535;
    sent = heartbeat_sent();
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_STATE_RUNNING_CHOICE, sent.state);
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_FROZEN_LEARNING_CHOICE, sent.frozen);
    TEST_ASSERT_EQUAL_UINT16(65535, sent.uptime);
}

static void test_a_heartbeat_tells_a_stopped_and_frozen_robot(void)
{
    struct octet_heartbeat_t sent;

    out.report.frozen = true;
    sent = heartbeat_sent();
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_STATE_STOPPED_CHOICE, sent.state);
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_FROZEN_FROZEN_CHOICE, sent.frozen);
}

static void test_a_heartbeat_tells_whose_clock_rules(void)
{
    wire.lockstep = true;
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_LOCKSTEP_LOCKSTEP_CHOICE, heartbeat_sent().lockstep);
}

static void test_a_heartbeat_tells_the_sum_of_all_faults(void)
{
    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        wire_count(&wire, (enum fault)fault);
        expect((enum fault)fault, 1);
    }
    TEST_ASSERT_EQUAL_UINT8(FAULT_COUNT, heartbeat_sent().faults);
}

static void test_the_sum_of_all_faults_stays_at_255(void)
{
    for (unsigned i = 0; i < 200; i++) {
        wire_count(&wire, FAULT_MISSED);
        wire_count(&wire, FAULT_STALE);
    }
    expect(FAULT_MISSED, 200);
    expect(FAULT_STALE, 200);
    TEST_ASSERT_EQUAL_UINT8(255, heartbeat_sent().faults);
}

static void test_each_fault_has_its_own_place(void)
{
    struct octet_faults_t sent;

    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        wire.faults[fault] = (uint8_t)(fault + 1);
        expect((enum fault)fault, (uint8_t)(fault + 1));
    }
    out.has_report = true;
    write();
    TEST_ASSERT_EQUAL(0, octet_faults_unpack(&sent, frames[2].data, frames[2].len));
    TEST_ASSERT_EQUAL_UINT8(FAULT_SILENCE + 1, sent.silences);
    TEST_ASSERT_EQUAL_UINT8(FAULT_MISSED + 1, sent.missed);
    TEST_ASSERT_EQUAL_UINT8(FAULT_STALE + 1, sent.stale);
    TEST_ASSERT_EQUAL_UINT8(FAULT_DAMAGED + 1, sent.damaged);
    TEST_ASSERT_EQUAL_UINT8(FAULT_FOREIGN + 1, sent.foreign);
    TEST_ASSERT_EQUAL_UINT8(FAULT_UNSENT + 1, sent.unsent);
    TEST_ASSERT_EQUAL_UINT8(FAULT_REFUSED + 1, sent.refused);
    TEST_ASSERT_EQUAL_UINT8(FAULT_UNSAVED + 1, sent.unsaved);
}

static void test_health_tells_how_the_bus_fares(void)
{
    struct octet_health_t sent;

    wire.health.reset_cause = RESET_WATCHDOG;
    wire.health.bus = (struct link_health){
        .state = BUS_OFF, .tx_errors = 255, .rx_errors = 128, .bus_offs = 7, .dropped = 9};
    out.has_report = true;
    write();
    TEST_ASSERT_EQUAL(0, octet_health_unpack(&sent, frames[1].data, frames[1].len));
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEALTH_RESET_CAUSE_WATCHDOG_CHOICE, sent.reset_cause);
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEALTH_BUS_STATE_BUS_OFF_CHOICE, sent.bus_state);
    TEST_ASSERT_EQUAL_UINT8(255, sent.tx_errors);
    TEST_ASSERT_EQUAL_UINT8(128, sent.rx_errors);
    TEST_ASSERT_EQUAL_UINT8(7, sent.bus_offs);
    TEST_ASSERT_EQUAL_UINT8(9, sent.dropped);
}

static void test_without_a_crash_no_report_tells_of_one(void)
{
    out.has_report = true;
    TEST_ASSERT_EQUAL_size_t(3, write());
}

static void test_a_crash_is_told_one_value_a_report_round_and_round(void)
{
    struct crash crash = {.cause = OCTET_CRASH_CAUSE_HARD_FAULT_CHOICE, .count = 5};

    for (uint32_t i = 0; i < crash.count; i++)
        crash.values[i] = 0xF0000000u + i;
    wire.health.crash = &crash;
    out.has_report = true;
    for (uint32_t i = 0; i < 3u * crash.count; i++) {
        struct octet_crash_t sent;

        TEST_ASSERT_EQUAL_size_t(4, write());
        TEST_ASSERT_EQUAL(0, octet_crash_unpack(&sent, frames[2].data, frames[2].len));
        TEST_ASSERT_EQUAL_UINT8(OCTET_CRASH_CAUSE_HARD_FAULT_CHOICE, sent.cause);
        TEST_ASSERT_EQUAL_UINT8(i % crash.count, sent.name);
        TEST_ASSERT_EQUAL_HEX32(0xF0000000u + i % crash.count, sent.value);
    }
}

static void test_a_memory_frame_is_the_eight_bytes(void)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 0};

    memcpy(out.memory, memory, sizeof memory);
    out.has_memory = true;
    write();
    TEST_ASSERT_EQUAL_UINT8(CELL_COUNT, frames[0].len);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(memory, frames[0].data, CELL_COUNT);
}

static void test_reset_causes_and_bus_states_are_those_of_the_dbc(void)
{
    TEST_ASSERT_EQUAL(OCTET_HEALTH_RESET_CAUSE_POWER_ON_CHOICE, RESET_POWER_ON);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_RESET_CAUSE_PIN_CHOICE, RESET_PIN);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_RESET_CAUSE_WATCHDOG_CHOICE, RESET_WATCHDOG);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_RESET_CAUSE_SOFTWARE_CHOICE, RESET_SOFTWARE);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_RESET_CAUSE_CRASH_CHOICE, RESET_CRASH);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_BUS_STATE_ACTIVE_CHOICE, BUS_ACTIVE);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_BUS_STATE_PASSIVE_CHOICE, BUS_PASSIVE);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_BUS_STATE_BUS_OFF_CHOICE, BUS_OFF);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_mark_makes_no_frame);
    RUN_TEST(test_all_marks_make_all_frames_the_drive_last);
    RUN_TEST(test_the_last_node_writes_its_own_identifiers);
    RUN_TEST(test_bytes_beyond_the_length_are_zero);
    RUN_TEST(test_drive_and_answer_bear_their_crc);
    RUN_TEST(test_wheel_speeds_keep_sign_and_size);
    RUN_TEST(test_a_drive_arrives_whole);
    RUN_TEST(test_an_answer_names_the_command_that_it_answers);
    RUN_TEST(test_a_refusal_is_counted_and_says_why);
    RUN_TEST(test_a_heartbeat_tells_how_the_robot_fares);
    RUN_TEST(test_a_heartbeat_tells_a_stopped_and_frozen_robot);
    RUN_TEST(test_a_heartbeat_tells_whose_clock_rules);
    RUN_TEST(test_a_heartbeat_tells_the_sum_of_all_faults);
    RUN_TEST(test_the_sum_of_all_faults_stays_at_255);
    RUN_TEST(test_each_fault_has_its_own_place);
    RUN_TEST(test_health_tells_how_the_bus_fares);
    RUN_TEST(test_without_a_crash_no_report_tells_of_one);
    RUN_TEST(test_a_crash_is_told_one_value_a_report_round_and_round);
    RUN_TEST(test_a_memory_frame_is_the_eight_bytes);
    RUN_TEST(test_reset_causes_and_bus_states_are_those_of_the_dbc);
    return UNITY_END();
}
