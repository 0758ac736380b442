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
