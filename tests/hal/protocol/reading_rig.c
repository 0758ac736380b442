#include "reading_rig.h"

#include <string.h>

#include <unity.h>

struct wire wire;
struct input in;
uint8_t expected_faults[FAULT_COUNT];

void setUp(void)
{
    wire_init(&wire, NODE);
    memset(expected_faults, 0, sizeof expected_faults);
}

void tearDown(void)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected_faults, wire.faults, FAULT_COUNT);
}

void expect(enum fault fault, uint8_t count)
{
    expected_faults[fault] = count;
}

struct frame command_of(enum opcode opcode, uint8_t counter, uint8_t owner)
{
    return command_frame((struct octet_command_t){.opcode = (uint8_t)opcode, .counter = counter, .owner = owner});
}

enum input_kind feed(struct frame frame)
{
    return wire_read(&wire, &frame, &in);
}

enum input_kind read_tick(unsigned ticks)
{
    return feed(senses_frame(NODE, ticks));
}

void assert_ignored(struct frame frame)
{
    const struct input before = in;

    TEST_ASSERT_EQUAL(INPUT_SILENCE, feed(frame));
    TEST_ASSERT_EQUAL_MEMORY(&before, &in, sizeof in);
}

struct frame respond(struct output out)
{
    struct frame frames[WIRE_FRAMES_MAX];

    return frames[wire_write(&wire, &out, frames) - 1];
}

void start(uint8_t lockstep, uint32_t value)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_frame((struct octet_command_t){
                                         .opcode = OPCODE_START, .counter = 1, .owner = OWNER, .lockstep = lockstep})));
    respond((struct output){.has_answer = true, .answer_value = value});
}
