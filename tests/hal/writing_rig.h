/* writing_rig.h: a robot's wire, and the frames that it writes for what a test puts out. */
#ifndef OCTET_WRITING_RIG_H
#define OCTET_WRITING_RIG_H

#include "hal/protocol/wire.h"

#include "firmware/config.h"
#include "firmware/memory.h"
#include "wire_frames.h"

enum { NODE = 1 };

extern struct wire wire;

extern struct output out;

extern struct frame frames[WIRE_FRAMES_MAX];

extern uint8_t expected_faults[FAULT_COUNT];

void expect(enum fault fault, uint8_t count);

size_t write_out(void);

void assert_ids(const uint32_t expected[], size_t count);

struct octet_answer_t answer_to(struct octet_command_t command, enum result result);

void whole_report(void);

#endif
