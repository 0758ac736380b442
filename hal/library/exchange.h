/* exchange.h: a robot as a library call, frames in and frames out: for running it within another program, as fast as it
 * goes. It is the same robot and the same wire as behind a bus; time is what the frames say. */
#ifndef OCTET_EXCHANGE_H
#define OCTET_EXCHANGE_H

#include "firmware/robot.h"
#include "hal/protocol/wire.h"

struct octet {
    struct robot robot;
    struct wire wire;
    struct frame answers[WIRE_FRAMES_MAX];
    void (*respond)(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out);
};

void octet_init(struct octet *octet, uint8_t node, const uint8_t memory[CELL_COUNT]);
        /* A robot as octet_open's, in memory of the caller's. Another robot_respond may take the place of the firmware's. */

struct octet *octet_open(uint8_t node, const uint8_t memory[CELL_COUNT]);
        /* A robot as after power-up, with what was stored; empty if that is not a memory. node is 1..NODE_MAX.
           Null if the machine is out of memory. */

size_t octet_exchange(struct octet *octet, const struct frame *in);
        /* Takes one frame and returns how many frames the robot answers: 0 to one that is stale, damaged or foreign, which
           is counted. */

void octet_outage(struct octet *octet);
        /* In real time: no senses have come for HAL_SILENCE_MS. The next ones are fresh, whatever their counter. */

const struct frame *octet_answers(const struct octet *octet);
        /* The answers to the last frame, in order. The address stays the same until octet_close. */

void octet_close(struct octet *octet);
        /* Frees it. A null octet is fine. */

#endif
