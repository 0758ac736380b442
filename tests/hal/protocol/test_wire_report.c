/* The contents of the parts of a report. */
#include <string.h>

#include "tests/test.h"
#include "build_id.h"
#include "writing_rig.h"

static struct octet_heartbeat_t heartbeat_sent(void)
{
    struct octet_heartbeat_t sent;

    out.has_report = out.has_drive = true;
    write_out();
    TEST_ASSERT_EQUAL(0, octet_heartbeat_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

TEST(heartbeat_counter_pauses_in_silence)
{
    static const uint8_t counters[] = {0, 1, 2, 2, 2, 3};

    for (unsigned i = 0; i < sizeof counters; i++) {
        out.silent = i == 2 || i == 3;
        TEST_ASSERT_EQUAL_UINT8(counters[i], heartbeat_sent().counter);
    }
}

TEST(heartbeat_reports_silence)
{
    out.silent = true;
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_SILENT_SILENT_CHOICE, heartbeat_sent().silent);
}

TEST(heartbeat_reports_the_owner)
{
    answer_to((struct octet_command_t){.opcode = OPCODE_START, .owner = 200}, RESULT_DONE);
    out = (struct output){.has_answer = false};
    TEST_ASSERT_EQUAL_UINT8(200, heartbeat_sent().owner);
}

TEST(heartbeat_reports_the_state_of_the_robot)
{
    struct octet_heartbeat_t sent;

    out.report.running = true;
    out.report.uptime_s = 65535;
    sent = heartbeat_sent();
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_STATE_RUNNING_CHOICE, sent.state);
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_FROZEN_LEARNING_CHOICE, sent.frozen);
    TEST_ASSERT_EQUAL_UINT16(65535, sent.uptime);
}

TEST(heartbeat_reports_stopped_and_frozen)
{
    struct octet_heartbeat_t sent;

    out.report.frozen = true;
    sent = heartbeat_sent();
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_STATE_STOPPED_CHOICE, sent.state);
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_FROZEN_FROZEN_CHOICE, sent.frozen);
}

TEST(heartbeat_reports_lockstep)
{
    wire.session.lockstep = true;
    TEST_ASSERT_EQUAL_UINT8(OCTET_HEARTBEAT_LOCKSTEP_LOCKSTEP_CHOICE, heartbeat_sent().lockstep);
}

TEST(heartbeat_reports_the_layout_hash)
{
    TEST_ASSERT_EQUAL_HEX16(LAYOUT_HASH, heartbeat_sent().layout);
}

TEST(faults_have_their_own_signals)
{
    struct octet_faults_t link, robot;

    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        wire.faults[fault] = (uint8_t)(fault + 1);
        expect((enum fault)fault, (uint8_t)(fault + 1));
    }
    out.has_report = out.whole_report = true;
    write_out();
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

TEST(health_reports_bus_clock_and_store)
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

TEST(boot_reports_the_reset_cause)
{
    struct octet_boot_t sent;

    wire.health.reset_cause = RESET_WATCHDOG;
    wire_boot(&wire, &frames[0]);
    TEST_ASSERT_TRUE(e2e_is_whole(&frames[0], OCTET_BOOT_LENGTH));
    TEST_ASSERT_EQUAL_UINT32(OCTET_BOOT_FRAME_ID, frames[0].id);
    TEST_ASSERT_EQUAL(0, octet_boot_unpack(&sent, frames[0].data, frames[0].len));
    TEST_ASSERT_EQUAL_UINT8(OCTET_BOOT_RESET_CAUSE_WATCHDOG_CHOICE, sent.reset_cause);
}

TEST(boot_reports_version_and_commit)
{
    struct octet_boot_t sent;

    wire_boot(&wire, &frames[0]);
    TEST_ASSERT_EQUAL(0, octet_boot_unpack(&sent, frames[0].data, frames[0].len));
    TEST_ASSERT_EQUAL_UINT8(OCTET_VERSION_MAJOR, sent.version_major);
    TEST_ASSERT_EQUAL_UINT8(OCTET_VERSION_MINOR, sent.version_minor);
    TEST_ASSERT_EQUAL_HEX32(OCTET_BUILD_COMMIT, sent.commit);
    TEST_ASSERT_EQUAL_UINT8(OCTET_BUILD_MODIFIED, sent.modified);
}

TEST(report_without_a_crash_has_no_crash_frame)
{
    whole_report();
    for (unsigned i = 0; i < 7; i++)
        TEST_ASSERT_NOT_EQUAL_HEX32(OCTET_CRASH_FRAME_ID, frames[i].id);
}

TEST(crash_values_rotate_one_per_report)
{
    static struct crash crash = {.cause = OCTET_CRASH_CAUSE_HARD_FAULT_CHOICE, .count = 5};

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

TEST(memory_is_two_frames_with_one_counter)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1, 2, 255, 4, 5, 6, 7};

    memcpy(out.memory, memory, sizeof memory);
    out.has_memory = true;
    for (uint8_t counter = 0; counter < 3; counter++) {
        TEST_ASSERT_EQUAL_size_t(2, write_out());
        for (unsigned half = 0; half < 2; half++) {
            TEST_ASSERT_EQUAL_HEX8(half << 4 | counter, frames[half].data[1]);
            TEST_ASSERT_EQUAL_UINT8_ARRAY(memory + 4 * half, frames[half].data + 2, 4);
        }
    }
}

TEST(reset_causes_and_bus_states_match_the_dbc)
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

/* Which parts of a report are sent, and when. */

TEST(report_parts_wait_for_drives_that_answer_senses)
{
    out.has_report = true;
    TEST_ASSERT_EQUAL_size_t(0, write_out());
    out.has_report = false;
    out.has_drive = out.silent = true;
    TEST_ASSERT_EQUAL_size_t(1, write_out());
    out.silent = false;
    TEST_ASSERT_EQUAL_size_t(2, write_out());
}

TEST(report_is_spread_over_several_drives)
{
    static const uint32_t ids[] = {0x6A1, 0x681, 0x781, 0x781, 0, 0x7C1, 0};

    for (unsigned i = 0; i < sizeof ids / sizeof ids[0]; i++) {
        out = (struct output){.has_report = i == 0, .has_drive = true};
        TEST_ASSERT_EQUAL_size_t(ids[i] == 0 ? 1 : ids[i] == 0x681 ? 3 : 2, write_out());
        TEST_ASSERT_EQUAL_HEX32(ids[i] == 0 ? 0x041 : ids[i], frames[0].id);
        if (frames[0].id == OCTET_HEALTH_FRAME_ID)
            TEST_ASSERT_EQUAL_UINT8(0, wire.part);   /* it has ended */
    }
}

TEST(whole_report_ends_a_partial_one)
{
    static const uint32_t drive = 0x041;

    out = (struct output){.has_report = true, .has_drive = true};
    write_out();
    whole_report();
    out = (struct output){.has_drive = true};
    assert_ids(&drive, 1);
}

TEST(start_ends_a_partial_report)
{
    static const uint32_t drive = 0x041;

    out = (struct output){.has_report = true, .has_drive = true};
    write_out();
    out = (struct output){.has_answer = true};
    (void)answer_to((struct octet_command_t){.counter = 1, .opcode = OPCODE_START}, RESULT_DONE);
    out = (struct output){.has_drive = true};
    assert_ids(&drive, 1);
}

TEST(start_of_an_owned_robot_keeps_a_partial_report)
{
    static const uint32_t ids[] = {0x681, 0x681, 0x041};

    (void)answer_to((struct octet_command_t){.counter = 1, .opcode = OPCODE_START, .owner = 1}, RESULT_DONE);
    out = (struct output){.has_report = true, .has_drive = true};
    write_out();
    out = (struct output){.has_answer = true};
    (void)answer_to((struct octet_command_t){.counter = 2, .opcode = OPCODE_START, .owner = 1}, RESULT_DONE);
    out = (struct output){.has_drive = true};
    assert_ids(ids, 3);
}

TEST(whole_report_flag_alone_sends_nothing)
{
    out = (struct output){.whole_report = true};
    TEST_ASSERT_EQUAL_size_t(0, write_out());
}

TEST(new_memory_is_sent_before_the_report)
{
    static const uint32_t ids[] = {0x681, 0x681, 0x041}, next[] = {0x6A1, 0x041};

    out = (struct output){.has_report = true, .has_memory = true, .has_drive = true};
    assert_ids(ids, 3);
    out = (struct output){.has_drive = true};
    assert_ids(next, 2);
}

TEST(silent_output_reports_a_heartbeat_only)
{
    static const uint32_t ids[] = {0x6A1, 0x041};

    out = (struct output){.has_report = true, .silent = true, .has_drive = true};
    assert_ids(ids, 2);
    out.has_report = false;
    assert_ids(ids + 1, 1);
    out.silent = false;
    assert_ids(ids + 1, 1);
    out = (struct output){.has_report = true, .whole_report = true, .silent = true};
    assert_ids(ids, 1);
}
