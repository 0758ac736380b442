#include "hal/protocol/wire.h"
#include "tests/test.h"
#include "firmware/config.h"
#include "firmware/memory/memory.h"
#include "hal/protocol/e2e.h"
#include "wire_frames.h"

#include "writing_rig.h"

static const struct crash CRASH = {.cause = 5, .count = 13, .values = {0x08000123, [12] = 0xFFFFFFFF}};

static void mark_all(void)
{
    wire.health.crash = &CRASH;
    out.has_answer = out.has_report = out.whole_report = out.has_drive = true;
}

TEST(output_without_content_writes_no_frame)
{
    TEST_ASSERT_EQUAL_size_t(0, write_out());
}

TEST(faults_alone_write_no_frame)
{
    wire_count(&wire, FAULT_DAMAGED);
    TEST_ASSERT_EQUAL_size_t(0, write_out());
    expect(FAULT_DAMAGED, 1);
}

TEST(all_pending_reports_are_written_with_drive_last)
{
    static const uint32_t ids[WIRE_FRAMES_MAX] = {0x141, 0x161, 0x6A1, 0x6C1, 0x681, 0x681, 0x781, 0x781, 0x7A1, 0x7C1, 0x041};

    mark_all();
    wire_count(&wire, FAULT_STALE);
    expect(FAULT_STALE, 1);
    assert_ids(ids, WIRE_FRAMES_MAX);
}

TEST(last_node_writes_its_own_identifiers)
{
    static const uint32_t ids[] = {0x15F, 0x6BF, 0x6DF, 0x69F, 0x69F, 0x79F, 0x79F, 0x7BF, 0x7DF, 0x05F};

    wire_init(&wire, NODE_MAX);
    mark_all();
    assert_ids(ids, WIRE_FRAMES_MAX - 1);
}

static struct octet_drive_t drive_sent(struct drive drive)
{
    struct octet_drive_t sent;

    out.has_drive = true;
    out.drive = drive;
    write_out();
    TEST_ASSERT_EQUAL(0, octet_drive_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

TEST(wheel_speeds_keep_sign_and_size)
{
    static const int16_t speeds[] = {-2047, -1, 0, 1, 2047};

    for (unsigned i = 0; i < 5; i++) {
        const struct octet_drive_t sent = drive_sent((struct drive){.left_mm_s = speeds[i], .right_mm_s = speeds[4 - i]});

        TEST_ASSERT_EQUAL_INT16(speeds[i], sent.left);
        TEST_ASSERT_EQUAL_INT16(speeds[4 - i], sent.right);
    }
}

TEST(drive_fields_are_packed)
{
    const struct octet_drive_t sent = drive_sent(
        (struct drive){.tick = 255, .reason = REASON_EAT, .repeat_count = 255, .action = 127, .eat = true});

    TEST_ASSERT_EQUAL_UINT8(255, sent.tick);
    TEST_ASSERT_EQUAL_UINT8(OCTET_DRIVE_REASON_EAT_CHOICE, sent.reason);
    TEST_ASSERT_EQUAL_UINT8(255, sent.repeat_count);
    TEST_ASSERT_EQUAL_UINT8(127, sent.action);
    TEST_ASSERT_EQUAL_UINT8(OCTET_DRIVE_EAT_EAT_CHOICE, sent.eat);
}

TEST(drive_has_the_counter_of_its_senses)
{
    const struct frame senses = senses_frame(NODE, 27);
    struct input in;

    TEST_ASSERT_EQUAL(INPUT_SENSES, wire_read(&wire, &senses, &in));
    TEST_ASSERT_EQUAL_UINT8(27 % 15, drive_sent((struct drive){.tick = 27}).counter);
}

/* A body on pins writes the senses that its robot acts on. */
TEST(senses_written_by_a_body_read_back)
{
    const struct senses senses = {
        .tick = 200, .feel = FEEL_FRONT | 1, .bump = true, .look = true, .beacon_mm = 300,
        .odometer_left = 4095, .odometer_right = 77,
    };
    struct frame frame;
    struct wire reader;
    struct input in;

    wire_init(&reader, NODE);
    wire_senses(&wire, &senses, &frame);
    TEST_ASSERT_EQUAL(INPUT_SENSES, wire_read(&reader, &frame, &in));
    TEST_ASSERT_EQUAL_UINT8(200, in.senses.tick);
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT | 1, in.senses.feel);
    TEST_ASSERT_TRUE(in.senses.bump);
    TEST_ASSERT_TRUE(in.senses.look);
    TEST_ASSERT_EQUAL_UINT16(300, in.senses.beacon_mm);
    TEST_ASSERT_EQUAL_UINT16(4095, in.senses.odometer_left);
    TEST_ASSERT_EQUAL_UINT16(77, in.senses.odometer_right);
}

TEST(answer_to_get_has_the_value)
{
    struct octet_answer_t sent;

    out.answer_value = 0x12345678;
    sent = answer_to((struct octet_command_t){.opcode = OPCODE_GET, .wanted = 12}, RESULT_DONE);
    TEST_ASSERT_EQUAL_UINT8(12, sent.which);
    TEST_ASSERT_EQUAL_HEX32(0x12345678, sent.value);
}

TEST(answer_names_its_command)
{
    const struct octet_answer_t sent = answer_to((struct octet_command_t){.opcode = OPCODE_FREEZE, .counter = 14, .freeze = 1}, RESULT_DONE);

    TEST_ASSERT_EQUAL_UINT8(14, sent.counter);
    TEST_ASSERT_EQUAL_UINT8(0, sent.which);
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_OPCODE_FREEZE_CHOICE, sent.opcode);
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_RESULT_DONE_CHOICE, sent.result);
}

TEST(refusal_is_counted_and_answered_with_the_reason)
{
    const struct octet_answer_t sent = answer_to((struct octet_command_t){.opcode = OPCODE_SET, .counter = 3}, RESULT_OUT_OF_RANGE);

    expect(FAULT_REFUSED, 1);
    TEST_ASSERT_EQUAL_UINT8(OCTET_ANSWER_RESULT_OUT_OF_RANGE_CHOICE, sent.result);
}

static struct octet_emergency_t emergency_sent(void)
{
    struct octet_emergency_t sent;

    out.has_drive = true;
    TEST_ASSERT_EQUAL_size_t(2, write_out());
    TEST_ASSERT_EQUAL_UINT32(OCTET_EMERGENCY_FRAME_ID, frames[0].id);
    TEST_ASSERT_EQUAL(0, octet_emergency_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

TEST(faults_are_reported_with_the_next_frame)
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

TEST(senses_written_by_a_body_set_counter_and_tick)
{
    struct octet_senses_t sent;
    struct frame frame;

    for (unsigned i = 1; i <= 2 * E2E_COUNTERS; i++) {
        wire_senses(&wire, &(struct senses){.tick = (uint8_t)(100 + i)}, &frame);
        TEST_ASSERT_EQUAL(0, octet_senses_unpack(&sent, frame.data, frame.len));
        TEST_ASSERT_EQUAL_UINT8(i % E2E_COUNTERS, sent.counter);
    }
    expect(FAULT_STALE, 1);
    wire_count(&wire, FAULT_STALE);
    TEST_ASSERT_EQUAL_UINT8(100 + 2 * E2E_COUNTERS, emergency_sent().tick);
}

TEST(faults_are_reported_once)
{
    wire_count(&wire, FAULT_STALE);
    expect(FAULT_STALE, 1);
    emergency_sent();
    TEST_ASSERT_EQUAL_size_t(1, write_out());
}

TEST(emergency_reports_the_sum_of_fault_counters)
{
    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        for (unsigned i = 0; i < 300; i++)
            wire_count(&wire, (enum fault)fault);
        expect((enum fault)fault, 255);
    }
    TEST_ASSERT_EQUAL_UINT16(255 * FAULT_COUNT, emergency_sent().faults);
}

TEST(faults_of_the_body_are_counted)
{
    out.contradiction = out.denied = true;
    emergency_sent();
    expect(FAULT_CONTRADICTION, 1);
    expect(FAULT_DENIED, 1);
}
