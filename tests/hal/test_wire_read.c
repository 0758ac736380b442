#include "hal/protocol/wire.h"

#include <string.h>

#include <unity.h>

#include "hal/protocol/crc8.h"
#include "octet.h"

enum { NODE = 1, ID_BITS = 11, BITS = ID_BITS + 64 };

static struct wire wire;
static struct input in;
static uint8_t expected_faults[FAULT_COUNT];   /* after each test: no other fault was counted */

void setUp(void)
{
    wire_init(&wire, NODE);
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

static struct frame sealed(struct frame frame)
{
    frame.data[0] = crc8_of_frame(&frame);
    return frame;
}

static struct frame senses_frame(unsigned node, uint16_t tick)
{
    const struct octet_senses_t senses = {
        .tick = tick, .feel = 21, .bump = 1, .look = 1, .beacon = 8191, .odometer_left = 4095, .odometer_right = 1};
    struct frame frame = {.id = OCTET_SENSES_FRAME_ID + node - 1u, .len = OCTET_SENSES_LENGTH};

    TEST_ASSERT_EQUAL(OCTET_SENSES_LENGTH, octet_senses_pack(frame.data, &senses, sizeof frame.data));
    return sealed(frame);
}

static struct frame command_frame(struct octet_command_t command)
{
    struct frame frame = {.id = OCTET_COMMAND_FRAME_ID, .len = OCTET_COMMAND_LENGTH};

    TEST_ASSERT_EQUAL(OCTET_COMMAND_LENGTH, octet_command_pack(frame.data, &command, sizeof frame.data));
    return sealed(frame);
}

static struct frame plain_command(uint8_t opcode, uint8_t counter)
{
    return command_frame((struct octet_command_t){.opcode = opcode, .counter = counter});
}

static enum input_kind read(struct frame frame)
{
    return wire_read(&wire, &frame, &in);
}

static enum input_kind read_tick(uint16_t tick)
{
    return read(senses_frame(NODE, tick));
}

/* Reads what must not get through. */
static void refuse(struct frame frame)
{
    const struct input before = in;

    TEST_ASSERT_EQUAL(INPUT_SILENCE, read(frame));
    TEST_ASSERT_EQUAL_MEMORY(&before, &in, sizeof in);
}

static void test_senses_arrive_whole(void)
{
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(4095));
    TEST_ASSERT_EQUAL_UINT16(4095, in.senses.tick);
    TEST_ASSERT_EQUAL_UINT8(21, in.senses.feel);
    TEST_ASSERT_TRUE(in.senses.bump);
    TEST_ASSERT_TRUE(in.senses.look);
    TEST_ASSERT_EQUAL_UINT16(8191, in.senses.beacon_mm);
    TEST_ASSERT_EQUAL_UINT16(4095, in.senses.odometer_left);
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.odometer_right);
}

static void assert_command(enum opcode opcode, unsigned which, uint32_t value)
{
    TEST_ASSERT_EQUAL(opcode, in.command.opcode);
    TEST_ASSERT_EQUAL_UINT8(which, in.command.which);
    TEST_ASSERT_EQUAL_HEX32(value, in.command.value);
}

static void test_start_brings_profile_and_seed(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, read(command_frame((struct octet_command_t){
                                       .opcode = OPCODE_START, .profile = 200, .seed = 0xFFFFFFFF})));
    assert_command(OPCODE_START, 200, 0xFFFFFFFF);
}

static void test_set_brings_parameter_and_value(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, read(command_frame((struct octet_command_t){
                                       .opcode = OPCODE_SET, .parameter = 12, .value = 65535})));
    assert_command(OPCODE_SET, 12, 65535);
}

static void test_write_brings_mask_and_cells(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, read(command_frame((struct octet_command_t){
                                       .opcode = OPCODE_WRITE, .mask = 0xFE, .cells = 0xAAA8})));
    assert_command(OPCODE_WRITE, 0xFE, 0xAAA8);
}

static void test_freeze_brings_its_flag(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, read(command_frame((struct octet_command_t){.opcode = OPCODE_FREEZE, .freeze = 1})));
    assert_command(OPCODE_FREEZE, 1, 0);
}

static void test_other_opcodes_bring_no_arguments(void)
{
    static const uint8_t opcodes[] = {OPCODE_STOP, OPCODE_RESUME, OPCODE_ERASE, 0, 8, 15};

    for (uint8_t i = 0; i < sizeof opcodes; i++) {
        TEST_ASSERT_EQUAL(INPUT_COMMAND, read(plain_command(opcodes[i], i)));
        assert_command((enum opcode)opcodes[i], 0, 0);
    }
}

static void test_each_command_says_whose_clock_rules(void)
{
    read(command_frame((struct octet_command_t){.opcode = OPCODE_RESUME, .counter = 1, .lockstep = 1}));
    TEST_ASSERT_TRUE(wire.lockstep);
    read(command_frame((struct octet_command_t){.opcode = OPCODE_RESUME, .counter = 2, .lockstep = 0}));
    TEST_ASSERT_FALSE(wire.lockstep);
}

static void test_each_node_hears_its_own_frames(void)
{
    for (uint8_t node = 1; node <= NODE_MAX; node++) {
        wire_init(&wire, node);
        TEST_ASSERT_EQUAL(INPUT_SENSES, read(senses_frame(node, 0)));
    }
}

static void test_no_node_hears_anothers_frames(void)
{
    unsigned foreign = 0;

    for (uint8_t node = 1; node <= NODE_MAX; node++)
        if (node != NODE) {
            refuse(senses_frame(node, 0));
            foreign++;
        }
    expect(FAULT_FOREIGN, (uint8_t)foreign);
}

static void test_the_first_and_the_last_node_listen_for_their_own(void)
{
    static const uint16_t expected[2][WIRE_LISTEN_COUNT] = {{193, 65}, {193 + 62, 65 + 62}};
    static const uint8_t nodes[2] = {1, NODE_MAX};
    uint16_t ids[WIRE_LISTEN_COUNT];

    for (unsigned i = 0; i < 2; i++) {
        wire_init(&wire, nodes[i]);
        wire_ids(&wire, ids);
        TEST_ASSERT_EQUAL_UINT16_ARRAY(expected[i], ids, WIRE_LISTEN_COUNT);
    }
}

static void test_what_robots_send_is_foreign_to_robots(void)
{
    refuse((struct frame){.id = OCTET_DRIVE_FRAME_ID, .len = 8});
    refuse((struct frame){.id = OCTET_ANSWER_FRAME_ID, .len = 3});
    expect(FAULT_FOREIGN, 2);
}

static void test_extended_remote_and_error_frames_are_foreign(void)
{
    static const uint32_t flags[] = {FRAME_EXTENDED, FRAME_REMOTE, FRAME_ERROR};

    for (unsigned i = 0; i < 3; i++) {
        struct frame frame = senses_frame(NODE, 0);

        frame.id |= flags[i];
        refuse(frame);
    }
    expect(FAULT_FOREIGN, 3);
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
    TEST_ASSERT_NOT_EQUAL(INPUT_SILENCE, read(good));   /* the clean control */
}

static void test_senses_with_one_or_two_flipped_bits_are_refused(void)
{
    refuse_every_flip(senses_frame(NODE, 1234));
}

static void test_a_command_with_one_or_two_flipped_bits_is_refused(void)
{
    refuse_every_flip(command_frame((struct octet_command_t){.opcode = OPCODE_START, .seed = 0x12345678}));
}

static void test_a_frame_of_another_length_is_damaged(void)
{
    for (uint8_t len = 0; len < 8; len++) {
        struct frame senses = senses_frame(NODE, 0), command = plain_command(OPCODE_STOP, 0);

        senses.len = command.len = len;
        refuse(sealed(senses));
        refuse(sealed(command));
    }
    expect(FAULT_DAMAGED, 16);
}

static void test_damaged_senses_do_not_move_the_tick(void)
{
    struct frame damaged = senses_frame(NODE, 100);

    read_tick(1);
    damaged.data[0] ^= 1;
    refuse(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(2));
}

static void test_any_tick_may_be_the_first(void)
{
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(3000));
}

static void test_the_tick_wraps(void)
{
    read_tick(4095);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(0));
}

static void test_senses_that_come_twice_are_stale(void)
{
    read_tick(5);
    refuse(senses_frame(NODE, 5));
    expect(FAULT_STALE, 1);
}

static void test_senses_from_behind_are_stale(void)
{
    read_tick(5);
    refuse(senses_frame(NODE, 4));
    refuse(senses_frame(NODE, (5 + 2048) % 4096));   /* as far behind as ahead */
    expect(FAULT_STALE, 2);
}

static void test_stale_senses_do_not_move_the_tick(void)
{
    read_tick(5);
    refuse(senses_frame(NODE, 3));
    expect(FAULT_STALE, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(6));
}

static void test_ticks_that_never_came_are_counted(void)
{
    read_tick(4094);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(2));   /* without 4095, 0 and 1 */
    expect(FAULT_MISSED, 3);
}

static void test_the_farthest_tick_ahead_is_fresh(void)
{
    read_tick(0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(2047));
    expect(FAULT_MISSED, 255);   /* 2046, and the counter stays at 255 */
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

static void test_after_stop_or_start_any_tick_is_taken(void)
{
    read_tick(100);
    read(plain_command(OPCODE_STOP, 0));
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(50));
    read(plain_command(OPCODE_START, 1));
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(20));
}

static void test_after_other_commands_the_tick_must_follow(void)
{
    read_tick(100);
    read(plain_command(OPCODE_RESUME, 0));
    refuse(senses_frame(NODE, 50));
    expect(FAULT_STALE, 1);
}

static void test_a_command_that_comes_twice_is_stale(void)
{
    read(plain_command(OPCODE_ERASE, 7));
    refuse(plain_command(OPCODE_ERASE, 7));
    expect(FAULT_STALE, 1);
}

static void test_any_other_counter_is_a_new_command(void)
{
    for (uint8_t counter = 0; counter < 16; counter++)
        TEST_ASSERT_EQUAL(INPUT_COMMAND, read(plain_command(OPCODE_ERASE, counter)));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, read(plain_command(OPCODE_ERASE, 3)));
}

static void test_a_damaged_command_does_not_use_up_its_counter(void)
{
    struct frame damaged = plain_command(OPCODE_ERASE, 7);

    damaged.data[7] ^= 1;
    refuse(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, read(plain_command(OPCODE_ERASE, 7)));
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
    RUN_TEST(test_write_brings_mask_and_cells);
    RUN_TEST(test_freeze_brings_its_flag);
    RUN_TEST(test_other_opcodes_bring_no_arguments);
    RUN_TEST(test_each_command_says_whose_clock_rules);
    RUN_TEST(test_each_node_hears_its_own_frames);
    RUN_TEST(test_no_node_hears_anothers_frames);
    RUN_TEST(test_the_first_and_the_last_node_listen_for_their_own);
    RUN_TEST(test_what_robots_send_is_foreign_to_robots);
    RUN_TEST(test_extended_remote_and_error_frames_are_foreign);
    RUN_TEST(test_senses_with_one_or_two_flipped_bits_are_refused);
    RUN_TEST(test_a_command_with_one_or_two_flipped_bits_is_refused);
    RUN_TEST(test_a_frame_of_another_length_is_damaged);
    RUN_TEST(test_damaged_senses_do_not_move_the_tick);
    RUN_TEST(test_any_tick_may_be_the_first);
    RUN_TEST(test_the_tick_wraps);
    RUN_TEST(test_senses_that_come_twice_are_stale);
    RUN_TEST(test_senses_from_behind_are_stale);
    RUN_TEST(test_stale_senses_do_not_move_the_tick);
    RUN_TEST(test_ticks_that_never_came_are_counted);
    RUN_TEST(test_the_farthest_tick_ahead_is_fresh);
    RUN_TEST(test_after_an_outage_any_tick_is_taken);
    RUN_TEST(test_an_outage_is_counted_once_however_long);
    RUN_TEST(test_before_the_first_senses_there_is_no_outage);
    RUN_TEST(test_after_stop_or_start_any_tick_is_taken);
    RUN_TEST(test_after_other_commands_the_tick_must_follow);
    RUN_TEST(test_a_command_that_comes_twice_is_stale);
    RUN_TEST(test_any_other_counter_is_a_new_command);
    RUN_TEST(test_a_damaged_command_does_not_use_up_its_counter);
    RUN_TEST(test_every_counter_stays_at_255);
    return UNITY_END();
}
