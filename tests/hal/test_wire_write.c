#include "hal/protocol/wire.h"

#include <string.h>

#include <unity.h>

#include "firmware/config.h"
#include "firmware/memory.h"
#include "wire_frames.h"

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
    out.has_answer = out.has_report = out.whole_report = out.has_drive = true;
}

static void test_no_mark_makes_no_frame(void)
{
    TEST_ASSERT_EQUAL_size_t(0, write());
}

static void test_faults_are_not_told_where_nothing_else_is(void)
{
    wire_count(&wire, FAULT_DAMAGED);
    TEST_ASSERT_EQUAL_size_t(0, write());
    expect(FAULT_DAMAGED, 1);
}

static void assert_ids(const uint32_t expected[], size_t count)
{
    TEST_ASSERT_EQUAL_size_t(count, write());
    for (unsigned i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL_HEX32(expected[i], frames[i].id);
        TEST_ASSERT_TRUE(e2e_is_whole(&frames[i], frames[i].len));
        for (unsigned beyond = frames[i].len; beyond < 8; beyond++)
            TEST_ASSERT_EQUAL_UINT8(0, frames[i].data[beyond]);
    }
}

static void test_the_parts_of_a_report_wait_for_drives_in_answer_to_senses(void)
{
    out.has_report = true;
    TEST_ASSERT_EQUAL_size_t(0, write());
    out.has_report = false;
    out.has_drive = out.silent = true;
    TEST_ASSERT_EQUAL_size_t(1, write());
    out.silent = false;
    TEST_ASSERT_EQUAL_size_t(2, write());
}

static void test_all_marks_make_all_frames_the_drive_last(void)
{
    static const uint32_t ids[WIRE_FRAMES_MAX] = {0x141, 0x161, 0x6A1, 0x6C1, 0x681, 0x681, 0x781, 0x781, 0x7A1, 0x7C1, 0x041};

    mark_all();
    wire_count(&wire, FAULT_STALE);
    expect(FAULT_STALE, 1);
    assert_ids(ids, WIRE_FRAMES_MAX);
}

static void test_the_last_node_writes_its_own_identifiers(void)
{
    static const uint32_t ids[] = {0x15F, 0x6BF, 0x6DF, 0x69F, 0x69F, 0x79F, 0x79F, 0x7BF, 0x7DF, 0x05F};

    wire_init(&wire, NODE_MAX);
    mark_all();
    assert_ids(ids, WIRE_FRAMES_MAX - 1);
}

static void test_a_report_is_spread_over_the_drives_of_many_ticks(void)
{
    static const uint32_t ids[] = {0x6A1, 0x681, 0x781, 0x781, 0, 0x7C1, 0};

    for (unsigned i = 0; i < sizeof ids / sizeof ids[0]; i++) {
        out = (struct output){.has_report = i == 0, .has_drive = true};
        TEST_ASSERT_EQUAL_size_t(ids[i] == 0 ? 1 : ids[i] == 0x681 ? 3 : 2, write());
        TEST_ASSERT_EQUAL_HEX32(ids[i] == 0 ? 0x041 : ids[i], frames[0].id);
    }
}

static void test_a_new_memory_holds_the_report_up(void)
{
    static const uint32_t ids[] = {0x681, 0x681, 0x041}, next[] = {0x6A1, 0x041};

    out = (struct output){.has_report = true, .has_memory = true, .has_drive = true};
    assert_ids(ids, 3);
    out = (struct output){.has_drive = true};
    assert_ids(next, 2);
}

static void test_in_silence_there_is_a_heartbeat_and_nothing_else(void)
{
    static const uint32_t ids[] = {0x6A1, 0x041};

    out = (struct output){.has_report = true, .silent = true, .has_drive = true};
    assert_ids(ids, 2);
    out.has_report = false;
    assert_ids(ids + 1, 1);
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
        (struct drive){.tick = 255, .reason = REASON_EAT, .repeat_count = 255, .action = 127, .eat = true});

    TEST_ASSERT_EQUAL_UINT8(255, sent.tick);
    TEST_ASSERT_EQUAL_UINT8(OCTET_DRIVE_REASON_EAT_CHOICE, sent.reason);
    TEST_ASSERT_EQUAL_UINT8(255, sent.repeat_count);
    TEST_ASSERT_EQUAL_UINT8(127, sent.action);
    TEST_ASSERT_EQUAL_UINT8(OCTET_DRIVE_EAT_EAT_CHOICE, sent.eat);
}

static struct octet_answer_t answer_to(struct octet_command_t command, enum result result)
{
    const struct frame frame = command_frame(command);
    struct octet_answer_t sent;
    struct input in;

    TEST_ASSERT_EQUAL(INPUT_COMMAND, wire_read(&wire, &frame, &in));
    out.has_answer = true;
    out.answer = result;
    write();
    TEST_ASSERT_EQUAL(0, octet_answer_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

static void test_a_drive_has_the_counter_of_the_senses_that_it_answers(void)
{
    const struct frame senses = senses_frame(NODE, 27);
    struct input in;

    TEST_ASSERT_EQUAL(INPUT_SENSES, wire_read(&wire, &senses, &in));
    TEST_ASSERT_EQUAL_UINT8(27 % 15, drive_sent((struct drive){.tick = 27}).counter);
}

static void test_an_answer_to_get_has_the_value(void)
{
    struct octet_answer_t sent;

    out.answer_value = 0x12345678;
    sent = answer_to((struct octet_command_t){.opcode = OPCODE_GET, .wanted = 12}, RESULT_DONE);
    TEST_ASSERT_EQUAL_UINT8(12, sent.which);
    TEST_ASSERT_EQUAL_HEX32(0x12345678, sent.value);
}

static void test_an_answer_names_the_command_that_it_answers(void)
{
    const struct octet_answer_t sent = answer_to((struct octet_command_t){.opcode = OPCODE_FREEZE, .counter = 14, .freeze = 1}, RESULT_DONE);

    TEST_ASSERT_EQUAL_UINT8(14, sent.counter);
    TEST_ASSERT_EQUAL_UINT8(0, sent.which);
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_OPCODE_FREEZE_CHOICE, sent.opcode);
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_RESULT_DONE_CHOICE, sent.result);
}

static void test_a_refusal_is_counted_and_says_why(void)
{
    const struct octet_answer_t sent = answer_to((struct octet_command_t){.opcode = OPCODE_SET, .counter = 3}, RESULT_OUT_OF_RANGE);

    expect(FAULT_REFUSED, 1);
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_RESULT_OUT_OF_RANGE_CHOICE, sent.result);
}

static struct octet_heartbeat_t heartbeat_sent(void)
{
    struct octet_heartbeat_t sent;

    out.has_report = out.has_drive = true;
    write();
    TEST_ASSERT_EQUAL(0, octet_heartbeat_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

static void test_each_heartbeat_counts_on_but_for_those_of_silence(void)
{
    static const uint8_t counters[] = {0, 1, 2, 2, 2, 3};

    for (unsigned i = 0; i < sizeof counters; i++) {
        out.silent = i == 2 || i == 3;
        TEST_ASSERT_EQUAL_UINT8(counters[i], heartbeat_sent().counter);
    }
}

static void test_a_heartbeat_tells_of_silence(void)
{
    out.silent = true;
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_SILENT_SILENT_CHOICE, heartbeat_sent().silent);
}

static void test_a_heartbeat_names_the_owner(void)
{
    answer_to((struct octet_command_t){.opcode = OPCODE_START, .owner = 200}, RESULT_DONE);
    out = (struct output){.has_answer = false};
    TEST_ASSERT_EQUAL_UINT8(200, heartbeat_sent().owner);
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
    wire.session.lockstep = true;
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_LOCKSTEP_LOCKSTEP_CHOICE, heartbeat_sent().lockstep);
}

static struct octet_emergency_t emergency_sent(void)
{
    struct octet_emergency_t sent;

    out.has_drive = true;
    TEST_ASSERT_EQUAL_size_t(2, write());
    TEST_ASSERT_EQUAL_UINT32(OCTET_EMERGENCY_FRAME_ID, frames[0].id);
    TEST_ASSERT_EQUAL(0, octet_emergency_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

static void test_faults_are_told_with_the_next_frame(void)
{
    struct octet_emergency_t sent;

    wire_count(&wire, FAULT_STALE);
    wire_count(&wire, FAULT_SILENCE);
    wire_count(&wire, FAULT_DENIED);
    expect(FAULT_STALE, 1);
    expect(FAULT_SILENCE, 1);
    expect(FAULT_DENIED, 1);
    sent = emergency_sent();
    TEST_ASSERT_EQUAL_UINT8(FAULT_STALE, sent.first);
    TEST_ASSERT_EQUAL_HEX16(1 << FAULT_STALE | 1 << FAULT_SILENCE | 1 << FAULT_DENIED, sent.kinds);
    TEST_ASSERT_EQUAL_UINT16(3, sent.faults);
}

static void test_faults_are_told_once(void)
{
    wire_count(&wire, FAULT_STALE);
    expect(FAULT_STALE, 1);
    emergency_sent();
    TEST_ASSERT_EQUAL_size_t(1, write());
}

static void test_the_sum_of_all_faults_is_that_of_the_counters(void)
{
    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        for (unsigned i = 0; i < 300; i++)
            wire_count(&wire, (enum fault)fault);
        expect((enum fault)fault, 255);
    }
    TEST_ASSERT_EQUAL_UINT16(255 * FAULT_COUNT, emergency_sent().faults);
}

static void test_faults_of_the_body_are_counted(void)
{
    out.contradiction = out.denied = true;
    emergency_sent();
    expect(FAULT_CONTRADICTION, 1);
    expect(FAULT_DENIED, 1);
}

static void test_each_fault_has_its_own_place(void)
{
    struct octet_faults_t link, robot;

    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        wire.faults[fault] = (uint8_t)(fault + 1);
        expect((enum fault)fault, (uint8_t)(fault + 1));
    }
    out.has_report = out.whole_report = true;
    write();
    TEST_ASSERT_EQUAL(0, octet_faults_unpack(&link, frames[4].data, frames[4].len));
    TEST_ASSERT_EQUAL(0, octet_faults_unpack(&robot, frames[5].data, frames[5].len));
    TEST_ASSERT_EQUAL_UINT8(link.counter, robot.counter);
    TEST_ASSERT_EQUAL_UINT8(FAULT_SILENCE + 1, link.silences);
    TEST_ASSERT_EQUAL_UINT8(FAULT_MISSED + 1, link.missed);
    TEST_ASSERT_EQUAL_UINT8(FAULT_STALE + 1, link.stale);
    TEST_ASSERT_EQUAL_UINT8(FAULT_DAMAGED + 1, link.damaged);
    TEST_ASSERT_EQUAL_UINT8(FAULT_FOREIGN + 1, link.foreign);
    TEST_ASSERT_EQUAL_UINT8(FAULT_UNSENT + 1, link.unsent);
    TEST_ASSERT_EQUAL_UINT8(FAULT_REFUSED + 1, robot.refused);
    TEST_ASSERT_EQUAL_UINT8(FAULT_UNSAVED + 1, robot.unsaved);
    TEST_ASSERT_EQUAL_UINT8(FAULT_TWIN + 1, robot.twins);
    TEST_ASSERT_EQUAL_UINT8(FAULT_CONTRADICTION + 1, robot.contradictions);
    TEST_ASSERT_EQUAL_UINT8(FAULT_DENIED + 1, robot.denied);
}

static void whole_report(void)
{
    out.has_report = out.whole_report = true;
    write();
}

static void test_health_tells_how_bus_clock_and_store_fare(void)
{
    struct octet_health_t sent;

    wire.health.unstored = wire.health.clock_exact = true;
    wire.health.bus = (struct link_health){
        .state = BUS_OFF, .tx_errors = 255, .rx_errors = 128, .bus_offs = 7, .dropped = 9};
    whole_report();
    TEST_ASSERT_EQUAL(0, octet_health_unpack(&sent, frames[6].data, frames[6].len));
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEALTH_BUS_STATE_BUS_OFF_CHOICE, sent.bus_state);
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEALTH_UNSTORED_UNSTORED_CHOICE, sent.unstored);
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEALTH_CLOCK_EXACT_CHOICE, sent.clock);
    TEST_ASSERT_EQUAL_UINT8(255, sent.tx_errors);
    TEST_ASSERT_EQUAL_UINT8(128, sent.rx_errors);
    TEST_ASSERT_EQUAL_UINT8(7, sent.bus_offs);
    TEST_ASSERT_EQUAL_UINT8(9, sent.dropped);
}

static void test_boot_tells_why_it_started(void)
{
    struct octet_boot_t sent;

    wire.health.reset_cause = RESET_WATCHDOG;
    wire_boot(&wire, &frames[0]);
    TEST_ASSERT_TRUE(e2e_is_whole(&frames[0], OCTET_BOOT_LENGTH));
    TEST_ASSERT_EQUAL_UINT32(OCTET_BOOT_FRAME_ID, frames[0].id);
    TEST_ASSERT_EQUAL(0, octet_boot_unpack(&sent, frames[0].data, frames[0].len));
    TEST_ASSERT_EQUAL_UINT8(OCTET_BOOT_RESET_CAUSE_WATCHDOG_CHOICE, sent.reset_cause);
}

static void test_without_a_crash_no_report_tells_of_one(void)
{
    whole_report();
    for (unsigned i = 0; i < 7; i++)
        TEST_ASSERT_TRUE(frames[i].id != OCTET_CRASH_FRAME_ID);
}

static void test_a_crash_is_told_one_value_a_report_round_and_round(void)
{
    struct crash crash = {.cause = OCTET_CRASH_CAUSE_HARD_FAULT_CHOICE, .count = 5};

    for (uint32_t i = 0; i < crash.count; i++)
        crash.values[i] = 0xF0000000u + i;
    wire.health.crash = &crash;
    for (uint32_t i = 0; i < 3u * crash.count; i++) {
        struct octet_crash_t sent;

        whole_report();
        TEST_ASSERT_EQUAL(0, octet_crash_unpack(&sent, frames[6].data, frames[6].len));
        TEST_ASSERT_EQUAL_UINT8(OCTET_CRASH_CAUSE_HARD_FAULT_CHOICE, sent.cause);
        TEST_ASSERT_EQUAL_UINT8(i % crash.count, sent.name);
        TEST_ASSERT_EQUAL_HEX32(0xF0000000u + i % crash.count, sent.value);
    }
}

static void test_a_memory_is_two_frames_with_one_counter(void)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1, 2, 255, 4, 5, 6, 7};

    memcpy(out.memory, memory, sizeof memory);
    out.has_memory = true;
    for (uint8_t counter = 0; counter < 3; counter++) {
        TEST_ASSERT_EQUAL_size_t(2, write());
        for (unsigned half = 0; half < 2; half++) {
            TEST_ASSERT_EQUAL_HEX8(half << 4 | counter, frames[half].data[1]);
            TEST_ASSERT_EQUAL_UINT8_ARRAY(memory + 4 * half, frames[half].data + 2, 4);
        }
    }
}

static void test_reset_causes_and_bus_states_are_those_of_the_dbc(void)
{
    TEST_ASSERT_EQUAL(OCTET_BOOT_RESET_CAUSE_POWER_ON_CHOICE, RESET_POWER_ON);
    TEST_ASSERT_EQUAL(OCTET_BOOT_RESET_CAUSE_PIN_CHOICE, RESET_PIN);
    TEST_ASSERT_EQUAL(OCTET_BOOT_RESET_CAUSE_WATCHDOG_CHOICE, RESET_WATCHDOG);
    TEST_ASSERT_EQUAL(OCTET_BOOT_RESET_CAUSE_SOFTWARE_CHOICE, RESET_SOFTWARE);
    TEST_ASSERT_EQUAL(OCTET_BOOT_RESET_CAUSE_CRASH_CHOICE, RESET_CRASH);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_BUS_STATE_ACTIVE_CHOICE, BUS_ACTIVE);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_BUS_STATE_PASSIVE_CHOICE, BUS_PASSIVE);
    TEST_ASSERT_EQUAL(OCTET_HEALTH_BUS_STATE_BUS_OFF_CHOICE, BUS_OFF);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_no_mark_makes_no_frame);
    RUN_TEST(test_faults_are_not_told_where_nothing_else_is);
    RUN_TEST(test_the_parts_of_a_report_wait_for_drives_in_answer_to_senses);
    RUN_TEST(test_all_marks_make_all_frames_the_drive_last);
    RUN_TEST(test_the_last_node_writes_its_own_identifiers);
    RUN_TEST(test_a_report_is_spread_over_the_drives_of_many_ticks);
    RUN_TEST(test_a_new_memory_holds_the_report_up);
    RUN_TEST(test_in_silence_there_is_a_heartbeat_and_nothing_else);
    RUN_TEST(test_wheel_speeds_keep_sign_and_size);
    RUN_TEST(test_a_drive_arrives_whole);
    RUN_TEST(test_a_drive_has_the_counter_of_the_senses_that_it_answers);
    RUN_TEST(test_an_answer_to_get_has_the_value);
    RUN_TEST(test_an_answer_names_the_command_that_it_answers);
    RUN_TEST(test_a_refusal_is_counted_and_says_why);
    RUN_TEST(test_each_heartbeat_counts_on_but_for_those_of_silence);
    RUN_TEST(test_a_heartbeat_tells_of_silence);
    RUN_TEST(test_a_heartbeat_names_the_owner);
    RUN_TEST(test_a_heartbeat_tells_how_the_robot_fares);
    RUN_TEST(test_a_heartbeat_tells_a_stopped_and_frozen_robot);
    RUN_TEST(test_a_heartbeat_tells_whose_clock_rules);
    RUN_TEST(test_faults_are_told_with_the_next_frame);
    RUN_TEST(test_faults_are_told_once);
    RUN_TEST(test_the_sum_of_all_faults_is_that_of_the_counters);
    RUN_TEST(test_faults_of_the_body_are_counted);
    RUN_TEST(test_each_fault_has_its_own_place);
    RUN_TEST(test_health_tells_how_bus_clock_and_store_fare);
    RUN_TEST(test_boot_tells_why_it_started);
    RUN_TEST(test_without_a_crash_no_report_tells_of_one);
    RUN_TEST(test_a_crash_is_told_one_value_a_report_round_and_round);
    RUN_TEST(test_a_memory_is_two_frames_with_one_counter);
    RUN_TEST(test_reset_causes_and_bus_states_are_those_of_the_dbc);
    return UNITY_END();
}
