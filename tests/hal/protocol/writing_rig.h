/* writing_rig.h: a robot's wire, and the frames that it writes for what a test puts out. */
#ifndef OCTET_WRITING_RIG_H
#define OCTET_WRITING_RIG_H

#include <string.h>

#include "tests/test.h"
#include "firmware/config.h"
#include "firmware/memory/memory.h"
#include "hal/protocol/wire.h"
#include "wire_frames.h"

enum { NODE = 1 };

static struct wire wire;
static struct output out;   /* to be written */
static struct frame frames[WIRE_FRAMES_MAX];   /* that were written last */
static uint8_t expected_faults[FAULT_COUNT];   /* after each test: no other fault was counted */

void setUp(void)
{
    wire_init(&wire, NODE);
    out = (struct output){.has_answer = false};
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

/* Writes out into frames. Returns how many these are. */
static inline size_t write_out(void)
{
    memset(frames, 0xA5, sizeof frames);   /* whatever was there before */
    return wire_write(&wire, &out, frames);
}

/* Writes out: frames with these identifiers, each whole and with zeros behind its length. */
static inline void assert_ids(const uint32_t expected[], size_t count)
{
    TEST_ASSERT_EQUAL_size_t(count, write_out());
    for (unsigned i = 0; i < count; i++) {
        TEST_ASSERT_EQUAL_HEX32(expected[i], frames[i].id);
        TEST_ASSERT_TRUE(e2e_is_whole(&frames[i], frames[i].len));
        for (unsigned beyond = frames[i].len; beyond < 8; beyond++)
            TEST_ASSERT_EQUAL_UINT8(0, frames[i].data[beyond]);
    }
}

/* The command is read, and the robot answers with that result. Returns what the ANSWER says. */
static inline struct octet_answer_t answer_to(struct octet_command_t command, enum result result)
{
    const struct frame frame = command_frame(command);
    struct octet_answer_t sent;
    struct input in;

    TEST_ASSERT_EQUAL(INPUT_COMMAND, wire_read(&wire, &frame, &in));
    out.has_answer = true;
    out.answer = result;
    write_out();
    TEST_ASSERT_EQUAL(0, octet_answer_unpack(&sent, frames[0].data, frames[0].len));
    return sent;
}

/* Writes all reports at once. */
static inline void whole_report(void)
{
    out.has_report = out.whole_report = true;
    write_out();
}

#endif
