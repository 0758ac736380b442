/* reading_rig.h: a robot's wire, and what it makes of the frames that a test has it read. */
#ifndef OCTET_READING_RIG_H
#define OCTET_READING_RIG_H

#include "hal/protocol/wire.h"

#include "wire_frames.h"

enum { NODE = 1, OWNER = 1, ID_BITS = 11, BITS = ID_BITS + 64 };

extern struct wire wire;

extern struct input in;

extern uint8_t expected_faults[FAULT_COUNT];

void expect(enum fault fault, uint8_t count);

struct frame command_of(enum opcode opcode, uint8_t counter, uint8_t owner);

enum input_kind hear(struct frame frame);

enum input_kind read_tick(unsigned ticks);

void refuse(struct frame frame);

struct frame respond(struct output out);

void start(uint8_t lockstep, uint32_t value);

#endif
