#include "hal/protocol/wire.h"

#include <string.h>

#include <unity.h>

#include "wire_frames.h"

#include "reading_rig.h"

static struct frame command_of(enum opcode opcode, uint8_t counter, uint8_t owner)
{
    return command_frame((struct octet_command_t){.opcode = (uint8_t)opcode, .counter = counter, .owner = owner});
}

static void test_senses_arrive_whole(void)
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

static void test_start_brings_profile_and_seed(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_frame((struct octet_command_t){
                                         .opcode = OPCODE_START, .profile = 100, .lockstep = 1, .seed = 0xFFFFFFFF})));
    assert_command(OPCODE_START, 100, 0xFFFFFFFF);
}

static void test_set_brings_parameter_and_value(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_frame((struct octet_command_t){
                                         .opcode = OPCODE_SET, .parameter = 12, .value = 65535})));
    assert_command(OPCODE_SET, 12, 65535);
}

static void test_get_brings_its_parameter(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_frame((struct octet_command_t){.opcode = OPCODE_GET, .wanted = 12})));
    assert_command(OPCODE_GET, 12, 0);
}

static void test_write_brings_half_mask_and_bytes(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND,
                      hear(command_frame((struct octet_command_t){.opcode = OPCODE_WRITE, .mask = 9, .half = 1,
                                                                  .byte_0 = 0x11, .byte_1 = 0x22, .byte_2 = 0x33,
                                                                  .byte_3 = 0xFF})));
    assert_command(OPCODE_WRITE, 0x19, 0xFF332211);
}

static void test_freeze_brings_its_flag(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_frame((struct octet_command_t){.opcode = OPCODE_FREEZE, .freeze = 1})));
    assert_command(OPCODE_FREEZE, 1, 0);
}

static void test_other_opcodes_bring_no_arguments(void)
{
    static const uint8_t opcodes[] = {OPCODE_STOP, OPCODE_RESUME, OPCODE_ERASE, OPCODE_REPORT, 0, 10, 15};

    for (uint8_t i = 0; i < sizeof opcodes; i++) {
        TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_of((enum opcode)opcodes[i], i, OWNER)));
        assert_command((enum opcode)opcodes[i], 0, 0);
    }
}

static void flip(struct frame *frame, unsigned bit)
{
    if (bit < ID_BITS)
        frame->id ^= 1u << bit;
    else
        frame->data[(bit - ID_BITS) / 8] ^= (uint8_t)(1u << (bit - ID_BITS) % 8);
}

/* Each is counted: as damaged, or as foreign where the identifier became another's. */
static void refuse_and_count(struct frame frame)
{
    memset(wire.faults, 0, sizeof wire.faults);
    refuse(frame);
    TEST_ASSERT_EQUAL_UINT(1, wire.faults[FAULT_DAMAGED] + wire.faults[FAULT_FOREIGN]);
    wire.faults[FAULT_DAMAGED] = wire.faults[FAULT_FOREIGN] = 0;
}

static void refuse_every_flip(const struct frame good)
{
    for (unsigned i = 0; i < BITS; i++) {
        struct frame one = good;

        flip(&one, i);
        refuse_and_count(one);
        for (unsigned j = 0; j < i; j++) {
            struct frame two = one;

            flip(&two, j);
            refuse_and_count(two);
        }
    }
    TEST_ASSERT_NOT_EQUAL(INPUT_SILENCE, hear(good));   /* the clean control */
}

static void test_senses_with_one_or_two_flipped_bits_are_refused(void)
{
    refuse_every_flip(senses_frame(NODE, 123));
}

static void test_a_command_with_one_or_two_flipped_bits_is_refused(void)
{
    refuse_every_flip(command_frame((struct octet_command_t){.opcode = OPCODE_START, .seed = 0x12345678}));
}

static void test_a_frame_of_another_length_is_damaged(void)
{
    for (uint8_t len = 0; len < 8; len++) {
        struct frame senses = senses_frame(NODE, 0), command = command_of(OPCODE_STOP, 0, OWNER), ranges = ranges_frame(0);

        senses.len = command.len = ranges.len = len;
        refuse(protected_frame(senses));
        refuse(protected_frame(command));
        refuse(protected_frame(ranges));
    }
    expect(FAULT_DAMAGED, 24);
}

static void test_damaged_senses_do_not_move_the_tick(void)
{
    struct frame damaged = senses_frame(NODE, 10);

    read_tick(1);
    damaged.data[0] ^= 1;
    refuse(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(2));
}

static void test_stale_senses_are_counted_and_not_answered(void)
{
    read_tick(5);
    refuse(senses_frame(NODE, 4));
    expect(FAULT_STALE, 1);
    TEST_ASSERT_NULL(wire.again);
}

static void test_ticks_that_never_came_are_counted(void)
{
    read_tick(254);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(258));
    expect(FAULT_MISSED, 3);
}

static void test_after_an_outage_any_tick_is_taken(void)
{
    read_tick(100);
    wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(50));
}

static void test_an_outage_is_counted_once_however_long(void)
{
    read_tick(100);
    for (unsigned i = 0; i < 10; i++)
        wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
}

static void test_before_the_first_senses_there_is_no_outage(void)
{
    wire_outage(&wire);
}

static void test_in_lockstep_an_outage_is_no_fault(void)
{
    start(1, 0);
    read_tick(5);
    wire_outage(&wire);
    refuse(senses_frame(NODE, 9));   /* the tick must go on as before */
    expect(FAULT_STALE, 1);
}

static void test_an_outage_loses_the_owner_the_robot(void)
{
    start(1, 0);
    wire_outage(&wire);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_of(OPCODE_ERASE, 9, OWNER + 1)));
}

static void test_in_lockstep_senses_again_before_any_answer_have_none(void)
{
    start(1, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(0));
    TEST_ASSERT_EQUAL(INPUT_SILENCE, read_tick(0));
    TEST_ASSERT_NULL(wire.again);
}

static void test_in_lockstep_senses_again_are_answered_as_before(void)
{
    struct frame drive;

    start(1, 0);
    read_tick(5);
    drive = respond((struct output){.has_drive = true, .drive = {.tick = 5, .left_mm_s = 200}});
    refuse(senses_frame(NODE, 5));
    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_EQUAL_MEMORY(&drive, wire.again, sizeof drive);
}

static void test_what_was_said_in_silence_is_not_said_again(void)
{
    struct frame drive;

    start(1, 0);
    read_tick(5);
    drive = respond((struct output){.has_drive = true, .drive = {.tick = 5, .left_mm_s = 200}});
    respond((struct output){.has_drive = true, .silent = true, .drive = {.tick = 5}});
    refuse(senses_frame(NODE, 5));
    TEST_ASSERT_EQUAL_MEMORY(&drive, wire.again, sizeof drive);
}

static void test_a_command_again_is_answered_as_before(void)
{
    struct frame answer;

    hear(command_of(OPCODE_ERASE, 7, OWNER));
    answer = respond((struct output){.has_answer = true});
    refuse(command_of(OPCODE_ERASE, 7, OWNER));
    TEST_ASSERT_NOT_NULL(wire.again);
    TEST_ASSERT_EQUAL_MEMORY(&answer, wire.again, sizeof answer);
}

static void test_what_was_said_goes_out_again_only_where_it_is_asked_for_again(void)
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

static void test_a_command_of_another_sender_is_answered_with_the_reason(void)
{
    start(0, 0);
    refuse(command_of(OPCODE_ERASE, 2, OWNER + 1));
    assert_answer(RESULT_OWNED, 2);
    expect(FAULT_REFUSED, 1);
}

static void test_an_old_command_is_answered_with_the_reason(void)
{
    start(0, 0);
    refuse(command_of(OPCODE_ERASE, 0, OWNER));
    assert_answer(RESULT_OUT_OF_SEQUENCE, 0);
    expect(FAULT_STALE, 1);
}

static void test_a_damaged_command_does_not_use_up_its_counter(void)
{
    struct frame damaged = command_of(OPCODE_ERASE, 7, OWNER);

    damaged.data[7] ^= 1;
    refuse(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_of(OPCODE_ERASE, 7, OWNER)));
}

static void test_every_counter_stays_at_255(void)
{
    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        for (unsigned i = 0; i < 300; i++)
            wire_count(&wire, (enum fault)fault);
        expect((enum fault)fault, 255);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_senses_arrive_whole);
    RUN_TEST(test_start_brings_profile_and_seed);
    RUN_TEST(test_set_brings_parameter_and_value);
    RUN_TEST(test_get_brings_its_parameter);
    RUN_TEST(test_write_brings_half_mask_and_bytes);
    RUN_TEST(test_freeze_brings_its_flag);
    RUN_TEST(test_other_opcodes_bring_no_arguments);
    RUN_TEST(test_senses_with_one_or_two_flipped_bits_are_refused);
    RUN_TEST(test_a_command_with_one_or_two_flipped_bits_is_refused);
    RUN_TEST(test_a_frame_of_another_length_is_damaged);
    RUN_TEST(test_damaged_senses_do_not_move_the_tick);
    RUN_TEST(test_stale_senses_are_counted_and_not_answered);
    RUN_TEST(test_ticks_that_never_came_are_counted);
    RUN_TEST(test_after_an_outage_any_tick_is_taken);
    RUN_TEST(test_an_outage_is_counted_once_however_long);
    RUN_TEST(test_before_the_first_senses_there_is_no_outage);
    RUN_TEST(test_in_lockstep_an_outage_is_no_fault);
    RUN_TEST(test_an_outage_loses_the_owner_the_robot);
    RUN_TEST(test_in_lockstep_senses_again_before_any_answer_have_none);
    RUN_TEST(test_in_lockstep_senses_again_are_answered_as_before);
    RUN_TEST(test_what_was_said_in_silence_is_not_said_again);
    RUN_TEST(test_a_command_again_is_answered_as_before);
    RUN_TEST(test_what_was_said_goes_out_again_only_where_it_is_asked_for_again);
    RUN_TEST(test_a_command_of_another_sender_is_answered_with_the_reason);
    RUN_TEST(test_an_old_command_is_answered_with_the_reason);
    RUN_TEST(test_a_damaged_command_does_not_use_up_its_counter);
    RUN_TEST(test_every_counter_stays_at_255);
    return UNITY_END();
}
