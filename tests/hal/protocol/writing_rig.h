/* writing_rig.h: a robot's wire, and the frames that it writes for what a test puts out. */
#ifndef OCTET_WRITING_RIG_H
#define OCTET_WRITING_RIG_H

#include "hal/protocol/wire.h"

#include "firmware/config.h"
#include "firmware/memory/memory.h"
#include "wire_frames.h"

enum { NODE = 1 };

extern struct wire wire;
extern struct output out;                       /* to be written */
extern struct frame frames[WIRE_FRAMES_MAX];    /* that were written last */
extern uint8_t expected_faults[FAULT_COUNT];    /* after each test: no other fault was counted */

void expect(enum fault fault, uint8_t count);
        /* That many of these are expected after the test. */

size_t write_out(void);
        /* Writes out into frames. Returns how many these are. */

void assert_ids(const uint32_t expected[], size_t count);
        /* Writes out: frames with these identifiers, each whole and with zeros behind its length. */

struct octet_answer_t answer_to(struct octet_command_t command, enum result result);
        /* The command is read, and the robot answers with that result. Returns what the ANSWER says. */

void whole_report(void);
        /* Writes all reports at once. */

#endif
