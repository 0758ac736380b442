/* What senses and commands bring. */
#include "tests/test.h"
#include "reading_rig.h"

TEST(senses_arrive_whole)
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

TEST(start_brings_profile_and_seed)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_frame((struct octet_command_t){
                                         .opcode = OPCODE_START, .profile = 100, .lockstep = 1, .seed = 0xFFFFFFFF})));
    assert_command(OPCODE_START, 100, 0xFFFFFFFF);
}

TEST(set_brings_parameter_and_value)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_frame((struct octet_command_t){
                                         .opcode = OPCODE_SET, .parameter = 12, .value = 65535})));
    assert_command(OPCODE_SET, 12, 65535);
}

TEST(get_brings_its_parameter)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_frame((struct octet_command_t){.opcode = OPCODE_GET, .wanted = 12})));
    assert_command(OPCODE_GET, 12, 0);
}

TEST(write_brings_half_mask_and_bytes)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND,
                      hear(command_frame((struct octet_command_t){.opcode = OPCODE_WRITE, .mask = 9, .half = 1,
                                                                  .byte_0 = 0x11, .byte_1 = 0x22, .byte_2 = 0x33,
                                                                  .byte_3 = 0xFF})));
    assert_command(OPCODE_WRITE, 0x19, 0xFF332211);
}

TEST(freeze_brings_its_flag)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_frame((struct octet_command_t){.opcode = OPCODE_FREEZE, .freeze = 1})));
    assert_command(OPCODE_FREEZE, 1, 0);
}

TEST(other_opcodes_bring_no_arguments)
{
    static const uint8_t opcodes[] = {OPCODE_STOP, OPCODE_RESUME, OPCODE_ERASE, OPCODE_REPORT, 0, 10, 15};

    for (uint8_t i = 0; i < sizeof opcodes; i++) {
        TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_of((enum opcode)opcodes[i], i, OWNER)));
        assert_command((enum opcode)opcodes[i], 0, 0);
    }
}

/* What comes again is answered again, and what is refused is answered with the reason. */

TEST(in_lockstep_senses_again_before_any_answer_have_none)
{
    start(1, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(0));
    TEST_ASSERT_EQUAL(INPUT_SILENCE, read_tick(0));
    TEST_ASSERT_NULL(wire.again);
}

TEST(in_lockstep_senses_again_are_answered_as_before)
{
    struct frame drive;

    start(1, 0);
    read_tick(5);
    drive = respond((struct output){.has_drive = true, .drive = {.tick = 5, .left_mm_s = 200}});
    refuse(senses_frame(NODE, 5));
    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_EQUAL_MEMORY(&drive, wire.again, sizeof drive);
}

TEST(what_was_said_in_silence_is_not_said_again)
{
    struct frame drive;

    start(1, 0);
    read_tick(5);
    drive = respond((struct output){.has_drive = true, .drive = {.tick = 5, .left_mm_s = 200}});
    respond((struct output){.has_drive = true, .silent = true, .drive = {.tick = 5}});
    refuse(senses_frame(NODE, 5));
    TEST_ASSERT_EQUAL_MEMORY(&drive, wire.again, sizeof drive);
}

TEST(a_command_again_is_answered_as_before)
{
    struct frame answer;

    hear(command_of(OPCODE_ERASE, 7, OWNER));
    answer = respond((struct output){.has_answer = true});
    refuse(command_of(OPCODE_ERASE, 7, OWNER));
    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_EQUAL_MEMORY(&answer, wire.again, sizeof answer);
}

TEST(what_was_said_goes_out_again_only_where_it_is_asked_for_again)
{
    hear(command_of(OPCODE_ERASE, 7, OWNER));
    respond((struct output){.has_answer = true});
    refuse(command_of(OPCODE_ERASE, 7, OWNER));
    refuse(senses_frame(NODE + 1, 0));
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
}

TEST(a_command_of_another_sender_is_answered_with_the_reason)
{
    start(0, 0);
    refuse(command_of(OPCODE_ERASE, 2, OWNER + 1));
    assert_answer(RESULT_OWNED, 2);
    expect(FAULT_REFUSED, 1);
}

TEST(an_old_command_is_answered_with_the_reason)
{
    start(0, 0);
    refuse(command_of(OPCODE_ERASE, 0, OWNER));
    assert_answer(RESULT_OUT_OF_SEQUENCE, 0);
    expect(FAULT_STALE, 1);
}

/* Senses that come late, not at all, or after an outage. */

TEST(stale_senses_are_counted_and_not_answered)
{
    read_tick(5);
    refuse(senses_frame(NODE, 4));
    expect(FAULT_STALE, 1);
    TEST_ASSERT_NULL(wire.again);
}

TEST(ticks_that_never_came_are_counted)
{
    read_tick(254);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(258));
    expect(FAULT_MISSED, 3);
}

TEST(after_an_outage_any_tick_is_taken)
{
    read_tick(100);
    wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(50));
}

TEST(an_outage_is_counted_once_however_long)
{
    read_tick(100);
    for (unsigned i = 0; i < 10; i++)
        wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
}

TEST(before_the_first_senses_there_is_no_outage)
{
    wire_outage(&wire);
}

TEST(in_lockstep_an_outage_is_no_fault)
{
    start(1, 0);
    read_tick(5);
    wire_outage(&wire);
    refuse(senses_frame(NODE, 9));   /* the tick must go on as before */
    expect(FAULT_STALE, 1);
}

TEST(an_outage_loses_the_owner_the_robot)
{
    start(1, 0);
    wire_outage(&wire);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_of(OPCODE_ERASE, 9, OWNER + 1)));
}
