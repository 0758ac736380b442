/* bxcan_parts.h: what the parts of the bxCAN ask of each other. */
#ifndef OCTET_BXCAN_PARTS_H
#define OCTET_BXCAN_PARTS_H

#include "host_sim/emulator/models/bxcan_model.h"

enum {
    BXCAN_TXRQ = 1 << 0,   /* in the first word of a mailbox, with the two below */
    BXCAN_RTR = 1 << 1,
    BXCAN_IDE = 1 << 2
};

void bxcan_release_due(struct can_node *node);
void bxcan_store(struct can_node *node, const struct frame *frame);
bool bxcan_offer(struct can_node *node, struct frame *out);
void bxcan_end(struct can_node *node, enum node_outcome outcome);

uint32_t bxcan_read_tsr(const struct bxcan *can);
void bxcan_write_tsr(struct bxcan *can, uint32_t value);
bool bxcan_write_mailbox(struct bxcan *can, uint32_t at, uint32_t value);
void bxcan_write_rfr(const struct bxcan *can, struct bxcan_fifo *fifo, uint32_t value);
int64_t bxcan_read_output(struct bxcan *can, uint32_t at);
bool bxcan_write_filters(struct bxcan *can, uint32_t offset, uint32_t value);

#endif
