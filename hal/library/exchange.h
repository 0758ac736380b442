/* exchange.h: a robot as a library, frames in and frames out, for running it within another program as fast as
 * possible. It is the same robot with the same protocol as on a bus; its time is that of the frames. */
#ifndef OCTET_EXCHANGE_H
#define OCTET_EXCHANGE_H

#include "firmware/robot.h"
#include "hal/protocol/wire.h"

struct octet {
    struct robot robot;
    struct wire wire;
    struct frame answers[WIRE_FRAMES_MAX];
    void (*respond)(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out);
    size_t size;   /* bytes of the whole robot from the start of this struct: more if it is part of a larger one */
};

void octet_init(struct octet *octet, uint8_t node, const uint8_t memory[CELL_COUNT]);
        /* Like octet_open, in memory of the caller, who may then replace respond, the firmware's robot_respond. */

struct octet *octet_open(uint8_t node, const uint8_t memory[CELL_COUNT]);
        /* Creates a robot as after power-up with this stored memory, or an empty one if it is not valid. node is
           1..NODE_MAX. Null if out of memory. */

size_t octet_exchange(struct octet *octet, const struct frame *in);
        /* Handles one frame and returns the number of answers: 0 if it is stale, damaged or foreign, which is
           counted. */

void octet_outage(struct octet *octet);
        /* In real time: no senses came for HAL_SILENCE_MS. The next ones are accepted with any counter. */

const struct frame *octet_answers(const struct octet *octet);
        /* The answers to the last frame, in order. The address stays the same until octet_close. */

size_t octet_size(const struct octet *octet);
        /* The number of bytes of its state, from its address on. Copied back to the same address, they restore it. */

void octet_close(struct octet *octet);
        /* Frees it; null is allowed. */

#endif
