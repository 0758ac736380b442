/* HEALTH's check of what the robot was told and remembers. */
#include "hal/flash_store/crc32.h"
#include "hal/protocol/e2e.h"
#include "tests/test.h"
#include "writing_rig.h"

static uint32_t told_here;   /* the checks as a client computes them: over commands, */
static uint32_t heard_here;  /* and over the senses obeyed in lockstep */
static uint8_t counter;

static uint16_t held(void)
{
    struct octet_health_t health;
    size_t count;

    out.has_answer = false;
    out.has_report = out.whole_report = true;
    count = write_out();
    TEST_ASSERT_EQUAL_HEX32(OCTET_HEALTH_FRAME_ID, frames[count - 1].id);
    TEST_ASSERT_EQUAL(0, octet_health_unpack(&health, frames[count - 1].data, frames[count - 1].len));
    return health.held;
}

static void tell(struct octet_command_t command, enum result result)
{
    struct frame frame;

    command.counter = counter = e2e_next(counter);
    command.owner = 3;
    frame = command_frame(command);
    (void)answer_to(command, result);
    told_here = crc32_more(told_here, frame.data + 1, 7);
}

static void assert_held(void)
{
    TEST_ASSERT_EQUAL_HEX16((uint16_t)(told_here ^ heard_here), held());
}

static void assert_held_with_memory(void)
{
    uint32_t told = crc32_more(told_here, out.memory, CELL_COUNT);

    TEST_ASSERT_EQUAL_HEX16((uint16_t)(told ^ heard_here), held());
}

static void begin(void)
{
    told_here = heard_here = 0;
    counter = 0;
    out = (struct output){.memory = {0, 1, 2, 1, 2, 1, 2, 1}};
}

TEST(check_value_before_any_command_covers_the_memory)
{
    begin();
    assert_held_with_memory();
    TEST_ASSERT_NOT_EQUAL(0, held());
}

TEST(check_value_covers_commands_in_order)
{
    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .profile = 7, .seed = 0xDEADBEEF, .lockstep = 1}, RESULT_DONE);
    assert_held();
    tell((struct octet_command_t){.opcode = OPCODE_SET, .parameter = 3, .value = 20}, RESULT_DONE);
    assert_held();
    tell((struct octet_command_t){.opcode = OPCODE_WRITE, .mask = 15, .half = 1, .byte_3 = 2}, RESULT_DONE);
    tell((struct octet_command_t){.opcode = OPCODE_ERASE}, RESULT_DONE);
    tell((struct octet_command_t){.opcode = OPCODE_FREEZE, .freeze = 1}, RESULT_DONE);
    tell((struct octet_command_t){.opcode = OPCODE_RESUME}, RESULT_DONE);
    assert_held();
}

TEST(repeated_start_changes_the_check_value)
{
    uint16_t before;

    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .seed = 5}, RESULT_DONE);
    before = held();
    tell((struct octet_command_t){.opcode = OPCODE_START, .seed = 5}, RESULT_DONE);
    TEST_ASSERT_NOT_EQUAL(before, held());
}

TEST(get_and_report_change_no_check_value)
{
    uint32_t before;

    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START}, RESULT_DONE);
    before = told_here;
    tell((struct octet_command_t){.opcode = OPCODE_GET, .wanted = 1}, RESULT_DONE);
    tell((struct octet_command_t){.opcode = OPCODE_REPORT}, RESULT_DONE);
    told_here = before;
    assert_held();
}

TEST(refused_command_changes_no_check_value)
{
    uint32_t before;

    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START}, RESULT_DONE);
    before = told_here;
    tell((struct octet_command_t){.opcode = OPCODE_SET, .parameter = 99}, RESULT_UNKNOWN_PARAMETER);
    told_here = before;
    expect(FAULT_REFUSED, 1);
    assert_held();
}

TEST(repeated_command_enters_the_check_value_once)
{
    const struct octet_command_t erase = {.opcode = OPCODE_ERASE, .counter = 1, .owner = 3};
    const struct frame again = command_frame(erase);
    struct input in;

    begin();
    tell(erase, RESULT_DONE);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, wire_read(&wire, &again, &in));
    assert_held_with_memory();
}

static struct frame read_senses_frame(uint8_t tick, uint8_t feel)
{
    const struct octet_senses_t senses = {.tick = tick, .counter = tick % 15, .feel = feel};
    struct frame frame = {.id = OCTET_SENSES_FRAME_ID, .len = OCTET_SENSES_LENGTH};
    struct input in;

    (void)octet_senses_pack(frame.data, &senses, sizeof frame.data);
    frame = protected_frame(frame);
    (void)wire_read(&wire, &frame, &in);
    return frame;
}

/* SENSES of tick 9; those that differ from the first ones, which feel nothing, are held. */
static void sense(uint8_t feel)
{
    bool are_first = !wire.session.knows_tick;
    struct frame frame = read_senses_frame(9, feel);

    if (feel != 0 && !are_first)
        told_here = crc32_more(told_here, frame.data + 1, 7);
    if (are_first && wire.session.lockstep)
        heard_here = crc32_more(heard_here, frame.data + 1, 7);
}

static struct frame drive_here;   /* that answered the senses before; zeros for none */

static void obey(uint8_t tick, uint8_t feel)
{
    struct frame frame = read_senses_frame(tick, feel);

    for (unsigned i = 1; i < 8; i++)
        frame.data[i] ^= drive_here.data[i];
    heard_here = crc32_more(heard_here, frame.data + 1, 7);
}

TEST(lockstep_check_value_covers_accepted_senses_in_order)
{
    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1}, RESULT_DONE);
    for (uint8_t tick = 1; tick < 60; tick++)
        obey(tick, tick & 7);
    assert_held();
    TEST_ASSERT_NOT_EQUAL(0, heard_here);
}

/* Answers the senses that came last. */
static struct frame drive(int16_t left_mm_s, bool silent)
{
    struct frame written;

    out.has_answer = out.has_report = false;
    out.has_drive = true;
    out.silent = silent;
    out.drive = (struct drive){.tick = wire.session.tick, .left_mm_s = left_mm_s, .eat = true};
    written = frames[write_out() - 1];
    out.has_drive = out.silent = false;
    return written;
}

TEST(check_value_covers_the_drive_before_the_senses)
{
    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1}, RESULT_DONE);
    obey(1, 0);
    drive_here = drive(-300, false);
    (void)drive(0, true);   /* reports silence, and answers no senses */
    (void)read_senses_frame(1, 0);   /* again */
    obey(2, 4);
    assert_held();
    (void)drive(5, false);
    assert_held();   /* the last one is not */
    tell((struct octet_command_t){.opcode = OPCODE_RESUME}, RESULT_DONE);
    heard_here = 0;
    drive_here = (struct frame){.len = 0};
    obey(3, 0);   /* the first ones follow no drive */
    assert_held();
}

TEST(refused_senses_change_no_check_value)
{
    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1}, RESULT_DONE);
    obey(1, 0);
    (void)read_senses_frame(3, 0);
    assert_held();
    expect(FAULT_STALE, 1);
}

TEST(start_resets_the_senses_check_value_and_first_stop_does_not)
{
    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1}, RESULT_DONE);
    obey(1, 4);
    tell((struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1}, RESULT_DONE);
    heard_here = 0;
    assert_held();
    obey(9, 4);
    tell((struct octet_command_t){.opcode = OPCODE_STOP}, RESULT_DONE);
    (void)read_senses_frame(10, 1);   /* without an owner */
    assert_held_with_memory();
    tell((struct octet_command_t){.opcode = OPCODE_STOP}, RESULT_DONE);
    told_here = heard_here = 0;
    assert_held_with_memory();
}

static void senses_of_one_tick(uint8_t lockstep)
{
    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .lockstep = lockstep}, RESULT_DONE);
    sense(0);
    sense(0);
    assert_held();
    sense(4);
    assert_held();
}

TEST(lockstep_check_value_covers_repeated_senses_that_differ)
{
    senses_of_one_tick(1);
}

TEST(real_time_check_value_covers_repeated_senses_that_differ)
{
    senses_of_one_tick(0);
    expect(FAULT_STALE, 2);
}

TEST(noisy_line_needs_two_equal_senses_for_the_check_value)
{
    const struct frame damaged = {.id = OCTET_SENSES_FRAME_ID, .len = OCTET_SENSES_LENGTH, .data = {1}};
    const struct frame foreign = {.id = OCTET_SENSES_FRAME_ID + 1, .len = OCTET_SENSES_LENGTH};
    struct input in;
    uint32_t before;

    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1}, RESULT_DONE);
    sense(0);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, wire_read(&wire, &damaged, &in));
    TEST_ASSERT_EQUAL(INPUT_SILENCE, wire_read(&wire, &foreign, &in));   /* another fault: it is still noisy */
    before = wire.session.told;
    sense(4);
    sense(5);
    TEST_ASSERT_EQUAL_HEX32(before, wire.session.told);
    sense(5);
    TEST_ASSERT_NOT_EQUAL(before, wire.session.told);
    (void)held();
    told_here = wire.session.told;   /* with a heartbeat, after which the line counts as clean */
    sense(6);
    assert_held();
    expect(FAULT_DAMAGED, 1);
    expect(FAULT_FOREIGN, 1);
}

TEST(first_senses_after_a_start_count_as_no_difference)
{
    uint32_t before;

    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1}, RESULT_DONE);
    sense(0);
    tell((struct octet_command_t){.opcode = OPCODE_START, .lockstep = 1}, RESULT_DONE);
    heard_here = 0;
    before = wire.session.told;
    sense(4);
    TEST_ASSERT_EQUAL_HEX32(before, wire.session.told);
    assert_held();
}

TEST(check_value_covers_first_stop_and_second_resets_it)
{
    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START}, RESULT_DONE);
    tell((struct octet_command_t){.opcode = OPCODE_STOP}, RESULT_DONE);
    assert_held_with_memory();
    tell((struct octet_command_t){.opcode = OPCODE_STOP}, RESULT_DONE);
    told_here = 0;
    assert_held_with_memory();
}

TEST(stop_answer_has_the_check_value_and_opcode_sum)
{
    struct octet_answer_t answer;

    begin();
    tell((struct octet_command_t){.opcode = OPCODE_START, .seed = 5}, RESULT_DONE);
    for (unsigned i = 0; i < 256; i++)   /* the sum has no more than the eight bits of a byte */
        tell((struct octet_command_t){.opcode = OPCODE_ERASE}, RESULT_DONE);
    tell((struct octet_command_t){.opcode = OPCODE_FREEZE}, RESULT_DONE);
    counter = e2e_next(counter);
    answer = answer_to((struct octet_command_t){.opcode = OPCODE_STOP, .counter = counter, .owner = 3}, RESULT_DONE);
    TEST_ASSERT_EQUAL_HEX32(told_here, answer.value);
    TEST_ASSERT_EQUAL_UINT8(OPCODE_START + OPCODE_FREEZE, answer.which);
}

TEST(check_value_covers_every_memory_cell)
{
    uint16_t before;

    begin();
    before = held();
    for (unsigned cell = 0; cell < CELL_COUNT; cell++) {
        out.memory[cell] ^= 3;
        TEST_ASSERT_NOT_EQUAL(before, held());
        out.memory[cell] ^= 3;
    }
    TEST_ASSERT_EQUAL_HEX16(before, held());
}
