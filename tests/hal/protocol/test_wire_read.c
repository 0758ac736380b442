/* The fields of senses and commands. */
#include "reading_rig.h"
#include "wire_frames.h"

#include "tests/test.h"
#include "hal/protocol/wire.h"

TEST(senses_fields_are_unpacked)
{
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(255));
    TEST_ASSERT_EQUAL_UINT8(255, in.senses.tick);
    TEST_ASSERT_EQUAL_UINT8(21, in.senses.feel);
    TEST_ASSERT_TRUE(in.senses.bump);
    TEST_ASSERT_TRUE(in.senses.look);
    TEST_ASSERT_EQUAL_UINT16(8191, in.senses.beacon_mm);
    TEST_ASSERT_EQUAL_UINT16(4095, in.senses.odometer_left);
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.odometer_right);
    TEST_ASSERT_EACH_EQUAL_UINT8(RANGE_NONE, in.senses.range_mm, FEEL_COUNT);
}

static void assert_command(enum opcode opcode, unsigned which, uint32_t value)
{
    TEST_ASSERT_EQUAL(opcode, in.command.opcode);
    TEST_ASSERT_EQUAL_UINT8(which, in.command.which);
    TEST_ASSERT_EQUAL_HEX32(value, in.command.value);
}

TEST(start_unpacks_profile_and_seed)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_frame((struct octet_command_t){
                                         .opcode = OPCODE_START, .profile = 100, .lockstep = 1, .seed = 0xFFFFFFFF})));
    assert_command(OPCODE_START, 100, 0xFFFFFFFF);
}

TEST(set_unpacks_parameter_and_value)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_frame((struct octet_command_t){
                                         .opcode = OPCODE_SET, .parameter = 12, .value = 65535})));
    assert_command(OPCODE_SET, 12, 65535);
}

TEST(get_unpacks_its_parameter)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_frame((struct octet_command_t){.opcode = OPCODE_GET, .wanted = 12})));
    assert_command(OPCODE_GET, 12, 0);
}

TEST(write_unpacks_half_mask_and_bytes)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND,
                      feed(command_frame((struct octet_command_t){.opcode = OPCODE_WRITE, .mask = 9, .half = 1,
                                                                  .byte_0 = 0x11, .byte_1 = 0x22, .byte_2 = 0x33,
                                                                  .byte_3 = 0xFF})));
    assert_command(OPCODE_WRITE, 0x19, 0xFF332211);
}

TEST(freeze_unpacks_its_flag)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_frame((struct octet_command_t){.opcode = OPCODE_FREEZE, .freeze = 1})));
    assert_command(OPCODE_FREEZE, 1, 0);
}

TEST(other_opcodes_unpack_no_arguments)
{
    static const uint8_t opcodes[] = {OPCODE_STOP, OPCODE_RESUME, OPCODE_ERASE, OPCODE_REPORT, 0, 10, 15};

    for (uint8_t i = 0; i < sizeof opcodes; i++) {
        TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_of((enum opcode)opcodes[i], i, OWNER)));
        assert_command((enum opcode)opcodes[i], 0, 0);
    }
}

/* Repeated frames are answered again, and refused ones with the reason. */

TEST(lockstep_repeated_senses_before_an_answer_get_none)
{
    start(1, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(0));
    TEST_ASSERT_EQUAL(INPUT_SILENCE, read_tick(0));
    TEST_ASSERT_NULL(wire.again);
}

TEST(lockstep_repeated_senses_get_the_same_answer)
{
    struct frame drive;

    start(1, 0);
    read_tick(5);
    drive = respond((struct output){.has_drive = true, .drive = {.tick = 5, .left_mm_s = 200}});
    assert_ignored(senses_frame(NODE, 5));
    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_EQUAL_MEMORY(&drive, wire.again, sizeof drive);
}

TEST(drive_in_silence_is_not_repeated)
{
    struct frame drive;

    start(1, 0);
    read_tick(5);
    drive = respond((struct output){.has_drive = true, .drive = {.tick = 5, .left_mm_s = 200}});
    respond((struct output){.has_drive = true, .silent = true, .drive = {.tick = 5}});
    assert_ignored(senses_frame(NODE, 5));
    TEST_ASSERT_EQUAL_MEMORY(&drive, wire.again, sizeof drive);
}

TEST(repeated_command_gets_the_same_answer)
{
    struct frame answer;

    feed(command_of(OPCODE_ERASE, 7, OWNER));
    answer = respond((struct output){.has_answer = true});
    assert_ignored(command_of(OPCODE_ERASE, 7, OWNER));
    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_EQUAL_MEMORY(&answer, wire.again, sizeof answer);
}

TEST(refused_repetition_gets_no_repeated_answer)
{
    feed(command_of(OPCODE_ERASE, 7, OWNER));
    respond((struct output){.has_answer = true});
    assert_ignored(command_of(OPCODE_ERASE, 7, OWNER));
    assert_ignored(senses_frame(NODE + 1, 0));
    expect(FAULT_FOREIGN, 1);
    TEST_ASSERT_NULL(wire.again);
}

static void assert_answer(enum result result, uint8_t counter)
{
    struct octet_answer_t answer;

    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_TRUE(e2e_is_whole(wire.again, OCTET_ANSWER_LENGTH));
    TEST_ASSERT_EQUAL_UINT32(OCTET_ANSWER_FRAME_ID, wire.again->id);
    TEST_ASSERT_EQUAL(0, octet_answer_unpack(&answer, wire.again->data, wire.again->len));
    TEST_ASSERT_EQUAL_UINT8(result, answer.result);
    TEST_ASSERT_EQUAL_UINT8(counter, answer.counter);
    TEST_ASSERT_EQUAL_UINT8(OPCODE_ERASE, answer.opcode);
}

TEST(command_of_another_sender_is_answered_with_the_reason)
{
    start(0, 0);
    assert_ignored(command_of(OPCODE_ERASE, 2, OWNER + 1));
    assert_answer(RESULT_OWNED, 2);
    expect(FAULT_REFUSED, 1);
}

TEST(old_command_is_answered_with_the_reason)
{
    start(0, 0);
    assert_ignored(command_of(OPCODE_ERASE, 0, OWNER));
    assert_answer(RESULT_OUT_OF_SEQUENCE, 0);
    expect(FAULT_STALE, 1);
}

/* Senses that come late, not at all, or after an outage. */

TEST(stale_senses_are_counted_and_not_answered)
{
    read_tick(5);
    assert_ignored(senses_frame(NODE, 4));
    expect(FAULT_STALE, 1);
    TEST_ASSERT_NULL(wire.again);
}

TEST(missed_ticks_are_counted)
{
    read_tick(254);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(258));
    expect(FAULT_MISSED, 3);
}

TEST(any_tick_is_accepted_after_an_outage)
{
    read_tick(100);
    wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(50));
}

TEST(outage_is_counted_once)
{
    read_tick(100);
    for (unsigned i = 0; i < 10; i++)
        wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
}

TEST(no_outage_is_counted_before_the_first_senses)
{
    wire_outage(&wire);
}

TEST(lockstep_outage_is_no_fault)
{
    start(1, 0);
    read_tick(5);
    wire_outage(&wire);
    assert_ignored(senses_frame(NODE, 9));   /* the tick must go on as before */
    expect(FAULT_STALE, 1);
}

TEST(owner_loses_control_after_an_outage)
{
    start(1, 0);
    wire_outage(&wire);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_of(OPCODE_ERASE, 9, OWNER + 1)));
}

TEST(unrequested_ranges_are_foreign)
{
    assert_ignored(ranges_frame(0));
    expect(FAULT_FOREIGN, 1);
}

TEST(ranges_are_added_to_the_senses_of_their_tick)
{
    static const uint8_t expected[FEEL_COUNT] = {11, 22, 33, 44, 55};

    start(1, ANSWER_WANTS_RANGES);
    assert_ignored(ranges_frame(7));
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(7));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, in.senses.range_mm, FEEL_COUNT);
}

TEST(lockstep_senses_wait_for_their_ranges)
{
    start(1, ANSWER_WANTS_RANGES);
    assert_ignored(ranges_frame(6));
    assert_ignored(senses_frame(NODE, 7));
    assert_ignored(ranges_frame(8));
    assert_ignored(senses_frame(NODE, 7));
    expect(FAULT_MISSED, 2);
    assert_ignored(ranges_frame(7));
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(7));
}

TEST(first_senses_of_a_run_need_ranges_of_that_run)
{
    start(1, ANSWER_WANTS_RANGES);
    assert_ignored(senses_frame(NODE, 0));
    assert_ignored(ranges_frame(0));
    feed(command_frame((struct octet_command_t){.opcode = OPCODE_START, .counter = 2, .owner = OWNER, .lockstep = 1}));
    respond((struct output){.has_answer = true, .answer_value = ANSWER_WANTS_RANGES});
    assert_ignored(senses_frame(NODE, 0));
    expect(FAULT_MISSED, 2);
}

TEST(damaged_ranges_are_counted_and_ignored)
{
    struct frame damaged = ranges_frame(7);

    start(1, ANSWER_WANTS_RANGES);
    damaged.data[7] ^= 1;
    assert_ignored(damaged);
    expect(FAULT_DAMAGED, 1);
    assert_ignored(senses_frame(NODE, 7));
    expect(FAULT_MISSED, 1);
}

TEST(real_time_senses_need_no_ranges)
{
    start(0, ANSWER_WANTS_RANGES);
    assert_ignored(ranges_frame(6));
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(7));
    TEST_ASSERT_EACH_EQUAL_UINT8(RANGE_NONE, in.senses.range_mm, FEEL_COUNT);
}

static struct frame twin_frame(uint32_t id, uint8_t len)
{
    return protected_frame((struct frame){.id = id, .len = len});
}

TEST(twin_stops_the_robot)
{
    const struct frame heard = twin_frame(OCTET_DRIVE_FRAME_ID, OCTET_DRIVE_LENGTH);

    start(1, 0);
    assert_ignored(heard);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(heard));
    TEST_ASSERT_EQUAL(OPCODE_STOP, in.command.opcode);
    expect(FAULT_TWIN, 2);
}

/* Of 10,000 frames of noise a second, one now and then has our identifier and a valid CRC. */
TEST(single_frame_per_second_is_no_twin)
{
    start(1, 0);
    for (unsigned second = 0; second < 10; second++) {
        assert_ignored(twin_frame(OCTET_DRIVE_FRAME_ID, OCTET_DRIVE_LENGTH));
        respond((struct output){.has_report = true, .has_drive = true});
    }
    expect(FAULT_TWIN, 10);
}

TEST(stop_for_a_twin_has_no_answer_and_clears_the_owner)
{
    struct output out = {.has_answer = true, .has_drive = true};
    struct frame frames[WIRE_FRAMES_MAX];

    start(1, 0);
    for (unsigned i = 0; i < 2; i++)
        feed(twin_frame(OCTET_HEARTBEAT_FRAME_ID, OCTET_HEARTBEAT_LENGTH));
    TEST_ASSERT_EQUAL_size_t(2, wire_write(&wire, &out, frames));
    TEST_ASSERT_EQUAL_UINT32(OCTET_EMERGENCY_FRAME_ID, frames[0].id);
    TEST_ASSERT_EQUAL_UINT8(0, wire.session.owner);
    expect(FAULT_TWIN, 2);
}

TEST(twin_stops_the_robot_once_per_start)
{
    const struct frame heard = twin_frame(OCTET_HEARTBEAT_FRAME_ID, OCTET_HEARTBEAT_LENGTH);

    assert_ignored(heard);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(heard));
    respond((struct output){.has_answer = true, .has_drive = true});
    assert_ignored(heard);
    start(1, 0);
    assert_ignored(heard);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(heard));
    expect(FAULT_TWIN, 5);
}

TEST(twin_is_detected_by_its_memory)
{
    assert_ignored(memory_frame(NODE, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(memory_frame(NODE, 1, 0)));
    expect(FAULT_TWIN, 2);
}

TEST(damaged_frame_of_a_twin_counts_as_damaged)
{
    assert_ignored((struct frame){.id = OCTET_DRIVE_FRAME_ID, .len = 8, .data = {1}});
    expect(FAULT_DAMAGED, 1);
}
