/* What the wire makes of a command's result, and when news of faults goes out. */
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

TEST(a_start_says_whether_ranges_are_wanted)
{
    started(ANSWER_WANTS_RANGES);
    TEST_ASSERT_TRUE(wire.wants_ranges);
    started(0);
    TEST_ASSERT_FALSE(wire.wants_ranges);
}

TEST(no_other_command_changes_whether_ranges_are_wanted)
{
    started(ANSWER_WANTS_RANGES);
    done(OPCODE_REPORT, 0);
    TEST_ASSERT_TRUE(wire.wants_ranges);
}

TEST(a_start_that_is_refused_changes_nothing_about_ranges)
{
    started(ANSWER_WANTS_RANGES);
    out = (struct output){.answer_value = 0};
    (void)answer_to((struct octet_command_t){.opcode = OPCODE_START, .counter = counted_up(), .owner = OWNER},
                    RESULT_UNKNOWN_PROFILE);
    TEST_ASSERT_TRUE(wire.wants_ranges);
    expect(FAULT_REFUSED, 1);
}

TEST(a_robot_that_has_an_owner_takes_nothing_from_another)
{
    started(0);
    TEST_ASSERT_FALSE(is_taken(OPCODE_SET, LOWER));
    TEST_ASSERT_FALSE(is_taken(OPCODE_SET, HIGHER));
    expect(FAULT_REFUSED, 2);
}

TEST(it_stays_its_owners_whatever_was_done)
{
    started(0);
    done(OPCODE_SET, 0);
    done(OPCODE_FREEZE, 0);
    TEST_ASSERT_FALSE(is_taken(OPCODE_SET, LOWER));
    TEST_ASSERT_TRUE(is_taken(OPCODE_SET, OWNER));
    expect(FAULT_REFUSED, 1);
}

TEST(a_stop_gives_the_robot_up)
{
    started(0);
    done(OPCODE_STOP, 0);
    TEST_ASSERT_TRUE(is_taken(OPCODE_SET, LOWER));
}

TEST(what_is_no_answer_is_no_refusal)
{
    out = (struct output){.has_drive = true, .answer = RESULT_OWNED};
    TEST_ASSERT_EQUAL_size_t(1, write_out());
}

TEST(news_goes_out_with_whatever_is_next)
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

TEST(news_waits_while_nothing_goes_out)
{
    wire_count(&wire, FAULT_UNSENT);
    expect(FAULT_UNSENT, 1);
    TEST_ASSERT_EQUAL_size_t(0, write_out());
}
