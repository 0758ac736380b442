/* bxcan_parts.h: what the parts of the bxCAN ask of each other. */
#ifndef OCTET_BXCAN_PARTS_H
#define OCTET_BXCAN_PARTS_H

#include "host_sim/emulator/models/bxcan_model.h"

#define BXCAN_NEVER UINT64_MAX

enum {
    BXCAN_TXRQ = 1 << 0,   /* in the first word of a mailbox, with the two below */
    BXCAN_RTR = 1 << 1,
    BXCAN_IDE = 1 << 2,
    BXCAN_PASSIVE = 128    /* from this error count on */
};

bool bxcan_refuse(struct bxcan *can, const char *format, ...);
        /* Always false. */

void bxcan_ask_mode(struct bxcan *can);
        /* Begins to wait for the mode that MCR asks for. */

uint64_t bxcan_advance_mode(struct bxcan *can);
        /* Enters a mode, or ends bus-off, if it is time. Returns when the next is due, or BXCAN_NEVER. */

void bxcan_recover(struct bxcan *can);
        /* Begins to wait for the end of bus-off. */

bool bxcan_is_passive(const struct bxcan *can);
uint32_t bxcan_error_status(const struct bxcan *can);
        /* ESR. */

void bxcan_release_due(struct bxcan *can);

uint32_t bxcan_read_tsr(const struct bxcan *can);
void bxcan_write_tsr(struct bxcan *can, uint32_t value);
bool bxcan_write_mailbox(struct bxcan *can, uint32_t at, uint32_t value);
void bxcan_write_rfr(const struct bxcan *can, struct bxcan_fifo *fifo, uint32_t value);
int64_t bxcan_read_output(struct bxcan *can, uint32_t at);
bool bxcan_write_filters(struct bxcan *can, uint32_t offset, uint32_t value);

#endif
