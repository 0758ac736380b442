/* reading_rig.h: a robot's wire, and what it makes of the frames that a test has it read. */
#ifndef OCTET_READING_RIG_H
#define OCTET_READING_RIG_H

#include <string.h>

#include "tests/test.h"
#include "hal/protocol/wire.h"
#include "wire_frames.h"

enum { NODE = 1, OWNER = 1, ID_BITS = 11, BITS = ID_BITS + 64 };

static struct wire wire;
static struct input in;   /* what the wire last made of a frame */
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

/* That many of these are expected after the test. */
static inline void expect(enum fault fault, uint8_t count)
{
    expected_faults[fault] = count;
}

static inline struct frame command_of(enum opcode opcode, uint8_t counter, uint8_t owner)
{
    return command_frame((struct octet_command_t){.opcode = (uint8_t)opcode, .counter = counter, .owner = owner});
}

/* The wire reads a frame. */
static inline enum input_kind feed(struct frame frame)
{
    return wire_read(&wire, &frame, &in);
}

/* The wire reads the senses of a tick, counted from 0 without end. */
static inline enum input_kind read_tick(unsigned ticks)
{
    return feed(senses_frame(NODE, ticks));
}

/* The wire reads what must not get through. */
static inline void assert_ignored(struct frame frame)
{
    const struct input before = in;

    TEST_ASSERT_EQUAL(INPUT_SILENCE, feed(frame));
    TEST_ASSERT_EQUAL_MEMORY(&before, &in, sizeof in);
}

/* The robot's answer, as hal_send would send it. Returns the last frame that it makes. */
static inline struct frame respond(struct output out)
{
    struct frame frames[WIRE_FRAMES_MAX];

    return frames[wire_write(&wire, &out, frames) - 1];
}

/* OWNER starts the robot, which answers with that value. */
static inline void start(uint8_t lockstep, uint32_t value)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_frame((struct octet_command_t){
                                         .opcode = OPCODE_START, .counter = 1, .owner = OWNER, .lockstep = lockstep})));
    respond((struct output){.has_answer = true, .answer_value = value});
}

#endif
