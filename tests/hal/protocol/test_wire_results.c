/* How the wire treats a command's result, and when new faults are reported. */
#include "hal/protocol/e2e.h"
#include "hal/protocol/wire.h"
#include "tests/test.h"
#include "writing_rig.h"

enum { OWNER = 5, LOWER = 2, HIGHER = 9 };

static uint8_t counter;

static uint8_t counted_up(void)
{
    counter = e2e_next(counter);
    return counter;
}

static void done(enum opcode opcode, uint32_t value)
{
    out = (struct output){.answer_value = value};
    (void)answer_to((struct octet_command_t){.opcode = (uint8_t)opcode, .counter = counted_up(), .owner = OWNER}, RESULT_DONE);
}

static void started(uint32_t value)
{
    done(OPCODE_START, value);
}

static bool is_taken(enum opcode opcode, uint8_t owner)
{
    const struct frame frame = command_frame(
        (struct octet_command_t){.opcode = (uint8_t)opcode, .counter = e2e_next(counter), .owner = owner});
    struct input in;

    return wire_read(&wire, &frame, &in) == INPUT_COMMAND;
}

TEST(start_answer_sets_whether_ranges_are_wanted)
{
    started(ANSWER_WANTS_RANGES);
    TEST_ASSERT_TRUE(wire.wants_ranges);
    started(0);
    TEST_ASSERT_FALSE(wire.wants_ranges);
}

TEST(other_commands_keep_whether_ranges_are_wanted)
{
    started(ANSWER_WANTS_RANGES);
    done(OPCODE_REPORT, 0);
    TEST_ASSERT_TRUE(wire.wants_ranges);
}

TEST(refused_start_keeps_whether_ranges_are_wanted)
{
    started(ANSWER_WANTS_RANGES);
    out = (struct output){.answer_value = 0};
    (void)answer_to((struct octet_command_t){.opcode = OPCODE_START, .counter = counted_up(), .owner = OWNER},
                    RESULT_UNKNOWN_PROFILE);
    TEST_ASSERT_TRUE(wire.wants_ranges);
    expect(FAULT_REFUSED, 1);
}

TEST(owned_robot_refuses_other_senders)
{
    started(0);
    TEST_ASSERT_FALSE(is_taken(OPCODE_SET, LOWER));
    TEST_ASSERT_FALSE(is_taken(OPCODE_SET, HIGHER));
    expect(FAULT_REFUSED, 2);
}

TEST(robot_keeps_its_owner_after_any_command)
{
    started(0);
    done(OPCODE_SET, 0);
    done(OPCODE_FREEZE, 0);
    TEST_ASSERT_FALSE(is_taken(OPCODE_SET, LOWER));
    TEST_ASSERT_TRUE(is_taken(OPCODE_SET, OWNER));
    expect(FAULT_REFUSED, 1);
}

TEST(stop_releases_the_robot_for_other_owners)
{
    started(0);
    done(OPCODE_STOP, 0);
    TEST_ASSERT_TRUE(is_taken(OPCODE_SET, LOWER));
}

TEST(refused_result_without_an_answer_counts_no_refusal)
{
    out = (struct output){.has_drive = true, .answer = RESULT_OWNED};
    TEST_ASSERT_EQUAL_size_t(1, write_out());
}

TEST(emergency_goes_out_with_the_next_output)
{
    const struct output next[] = {{.has_drive = true}, {.has_report = true, .whole_report = true}, {.has_answer = true}};

    for (unsigned i = 0; i < 3; i++) {
        wire_count(&wire, FAULT_UNSENT);
        out = next[i];
        write_out();
        TEST_ASSERT_EQUAL_HEX32(OCTET_EMERGENCY_FRAME_ID, frames[out.has_answer ? 1 : 0].id);
    }
    expect(FAULT_UNSENT, 3);
}

TEST(emergency_waits_for_the_next_output)
{
    wire_count(&wire, FAULT_UNSENT);
    expect(FAULT_UNSENT, 1);
    TEST_ASSERT_EQUAL_size_t(0, write_out());
}

/* The frames of each kind: their length, and a counter of their own. */

static const struct crash CRASH = {.cause = 1, .count = 1, .values = {1}};

static const struct {
    uint32_t id;
    uint8_t len;
    enum counted kind;   /* COUNTED_KINDS: numbered as what it answers */
} KINDS[] = {
    {OCTET_EMERGENCY_FRAME_ID, OCTET_EMERGENCY_LENGTH, COUNTED_EMERGENCY},
    {OCTET_MEMORY_FRAME_ID, OCTET_MEMORY_LENGTH, COUNTED_MEMORY},
    {OCTET_HEARTBEAT_FRAME_ID, OCTET_HEARTBEAT_LENGTH, COUNTED_HEARTBEAT},
    {OCTET_BOOT_FRAME_ID, OCTET_BOOT_LENGTH, COUNTED_BOOT},
    {OCTET_FAULTS_FRAME_ID, OCTET_FAULTS_LENGTH, COUNTED_FAULTS},
    {OCTET_CRASH_FRAME_ID, OCTET_CRASH_LENGTH, COUNTED_CRASH},
    {OCTET_HEALTH_FRAME_ID, OCTET_HEALTH_LENGTH, COUNTED_HEALTH},
    {OCTET_ANSWER_FRAME_ID, OCTET_ANSWER_LENGTH, COUNTED_KINDS},
    {OCTET_DRIVE_FRAME_ID, OCTET_DRIVE_LENGTH, COUNTED_KINDS},
};

enum { KIND_COUNT = sizeof KINDS / sizeof *KINDS };

/* Everything at once: a fault that is news, an answer, a whole report with a crash, and a drive. */
static size_t write_all_kinds(void)
{
    wire.health.crash = &CRASH;
    wire_count(&wire, FAULT_UNSENT);
    expect(FAULT_UNSENT, 1);
    out = (struct output){.has_answer = true, .has_report = true, .whole_report = true, .has_drive = true,
                          .memory = {1, 2, 3, 4, 5, 6, 7, 8}};
    return write_out();
}

static unsigned kind_of(const struct frame *frame)
{
    unsigned kind = 0;

    while (kind < KIND_COUNT && KINDS[kind].id != frame->id)
        kind++;
    TEST_ASSERT_LESS_THAN_UINT(KIND_COUNT, kind);
    return kind;
}

TEST(frames_have_their_dbc_lengths)
{
    const size_t count = write_all_kinds();
    unsigned seen = 0;

    for (unsigned i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL_UINT8(KINDS[kind_of(&frames[i])].len, frames[i].len);
        seen |= 1u << kind_of(&frames[i]);
    }
    TEST_ASSERT_EQUAL_HEX32((1u << KIND_COUNT) - 1, seen);
}

TEST(message_kinds_have_separate_counters)
{
    size_t count;

    for (unsigned kind = 0; kind < COUNTED_KINDS; kind++)
        wire.counters[kind] = (uint8_t)(kind + 3);
    count = write_all_kinds();
    for (unsigned i = 0; i < count; i++) {
        enum counted kind = KINDS[kind_of(&frames[i])].kind;

        if (kind != COUNTED_KINDS)
            TEST_ASSERT_EQUAL_UINT8(kind + 3, frames[i].data[1] & 0x0F);
    }
    for (unsigned kind = 0; kind < COUNTED_KINDS; kind++)
        TEST_ASSERT_EQUAL_UINT8(kind + 4, wire.counters[kind]);
}

TEST(bytes_beyond_the_length_are_zero)
{
    const size_t count = write_all_kinds();

    for (unsigned i = 0; i < count; i++)
        for (unsigned beyond = frames[i].len; beyond < 8; beyond++)
            TEST_ASSERT_EQUAL_HEX8(0, frames[i].data[beyond]);
}

TEST(fault_pages_share_one_counter)
{
    const size_t count = write_all_kinds();
    unsigned pages = 0;

    for (unsigned i = 0; i < count; i++)
        if (frames[i].id == OCTET_FAULTS_FRAME_ID)
            TEST_ASSERT_EQUAL_HEX8(pages++ << 4, frames[i].data[1]);
    TEST_ASSERT_EQUAL_UINT(2, pages);
}
