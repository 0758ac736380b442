/* fdcan_parts.h: what the parts of FDCAN ask of each other. */
#ifndef OCTET_FDCAN_PARTS_H
#define OCTET_FDCAN_PARTS_H

#include "host_sim/emulator/models/fdcan_model.h"

enum {
    FDCAN_ELEMENT_WORDS = 18,
    FDCAN_RECEIVED = 0xB0 / 4, FDCAN_SENT = 0x278 / 4,   /* words of the message RAM at which elements begin */
    FDCAN_LOST = 1 << 2, FDCAN_FLAGS_OF_FIFO = 3         /* in IR: of FIFO 0, those of FIFO 1 follow */
};

void fdcan_store(struct can_node *node, const struct frame *frame);
uint32_t fdcan_read_fifo(const struct fdcan *can, unsigned n);
        /* RXFnS. */

bool fdcan_release(struct fdcan *can, unsigned n, uint32_t place);
        /* RXFnA is written. */

bool fdcan_offer(struct can_node *node, struct frame *out);
void fdcan_end(struct can_node *node, enum node_outcome outcome);
uint32_t fdcan_read_queue(const struct fdcan *can);
        /* TXFQS. */

bool fdcan_ask_to_send(struct fdcan *can, uint32_t buffers);
void fdcan_ask_to_give_up(struct fdcan *can, uint32_t buffers);

#endif
