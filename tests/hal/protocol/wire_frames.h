/* wire_frames.h: frames as a simulator sends them. */
#ifndef OCTET_WIRE_FRAMES_H
#define OCTET_WIRE_FRAMES_H

#include "hal/protocol/e2e.h"
#include "octet.h"

struct frame protected_frame(struct frame frame);

struct frame senses_frame(unsigned node, unsigned ticks);
        /* The senses of a tick, counted from 0 without end. */

struct frame ranges_frame(unsigned ticks);
        /* 11, 22, 33, 44 and 55 mm, for node 1. */

struct frame memory_frame(unsigned node, unsigned half, uint8_t first);
        /* Half of the memory of a robot, whose four cells are first, 1, 2 and 1. */

struct frame command_frame(struct octet_command_t command);
        /* For node 1. */

#endif
