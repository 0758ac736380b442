/* reading_rig.h: a robot's wire, and what it makes of the frames that a test has it read. */
#ifndef OCTET_READING_RIG_H
#define OCTET_READING_RIG_H

#include "hal/protocol/wire.h"

#include "wire_frames.h"

enum { NODE = 1, OWNER = 1, ID_BITS = 11, BITS = ID_BITS + 64 };

extern struct wire wire;
extern struct input in;                         /* what the wire last made of a frame */
extern uint8_t expected_faults[FAULT_COUNT];    /* after each test: no other fault was counted */

void expect(enum fault fault, uint8_t count);
        /* That many of these are expected after the test. */

struct frame command_of(enum opcode opcode, uint8_t counter, uint8_t owner);

enum input_kind feed(struct frame frame);
        /* The wire reads a frame. */

enum input_kind read_tick(unsigned ticks);
        /* The wire reads the senses of a tick, counted from 0 without end. */

void assert_ignored(struct frame frame);
        /* The wire reads what must not get through. */

struct frame respond(struct output out);
        /* The robot's answer, as hal_send would send it. Returns the last frame that it makes. */

void start(uint8_t lockstep, uint32_t value);
        /* OWNER starts the robot, which answers with that value. */

#endif
