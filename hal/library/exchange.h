/* exchange.h: a robot as a library call, frames in and frames out: for running it within another program, as fast as it
 * goes. It is the same robot and the same wire as behind a bus; time is what the frames say. */
#ifndef OCTET_EXCHANGE_H
#define OCTET_EXCHANGE_H

#include "firmware/robot.h"
#include "hal/protocol/wire.h"

struct session {
    struct robot robot;
    struct wire wire;
};

struct session *session_open(uint8_t node, const uint8_t memory[CELL_COUNT]);
        /* A robot as after power-up, with what was stored; nothing, if that is no memory. node is 1..NODE_MAX.
           Null where the machine has no room. */

size_t session_exchange(struct session *session, const struct frame *in, struct frame out[WIRE_FRAMES_MAX]);
        /* Takes one frame and returns how many frames the robot answers, 0..WIRE_FRAMES_MAX. A frame that is stale,
           damaged or foreign is counted and gets no answer. */

void session_close(struct session *session);
        /* Frees it. A null session is fine. */

#endif
