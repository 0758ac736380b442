/* frames.h: the frames of one output, as they are being built. */
#ifndef OCTET_FRAMES_H
#define OCTET_FRAMES_H

#include "hal/protocol/wire.h"

struct frames {
    struct frame *first;
    size_t count;
};

struct frame *frames_add(struct frames *frames, const struct wire *wire, uint32_t id_of_node_1, uint8_t len);
        /* Appends a frame of zeros. The identifier is that of node 1 in octet.dbc; it becomes that of this node. */

uint8_t frames_count_up(struct wire *wire, enum counted kind);
        /* Returns the alive counter for a message of this kind, and advances it. */

#endif
