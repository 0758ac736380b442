/* bxcan_model.h: the bxCAN controller (RM0090 chapter 32, RM0008 chapter 24), as a polling driver sees it. Accesses
 * that the manual forbids or that are not modelled are refused with a reason. Python reads this header too. */
#ifndef OCTET_BXCAN_MODEL_H
#define OCTET_BXCAN_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/emulator/models/can_node.h"

enum {
    BXCAN_MAILBOXES = 3,
    BXCAN_FIFO_DEPTH = 3,
    BXCAN_BANKS_MAX = 28
};

struct bxcan_mailbox {
    uint32_t words[4];     /* TIxR, TDTxR, TDLxR, TDHxR */
    uint32_t status;       /* its bits of TSR, shifted down */
    unsigned request;      /* which request it was, in order of time */
    bool pending;
    bool aborting;
};

struct bxcan_fifo {
    struct frame frames[BXCAN_FIFO_DEPTH];
    unsigned count;
    uint32_t flags;        /* FULL, FOVR, RFOM */
    uint64_t release_ns;   /* when RFOM has done its work */
};

struct bxcan_filters {
    uint32_t words[16];    /* FMR, FM1R, -, FS1R, -, FFA1R, -, FA1R, - */
    uint32_t banks[2 * BXCAN_BANKS_MAX];
};

struct bxcan {
    struct can_node node;
    unsigned bank_count;
    bool release_slow;         /* a fault: a released frame remains visible for 0.1 ms, as RFOM shows */

    uint32_t mcr, btr, ier;
    struct bxcan_mailbox mailboxes[BXCAN_MAILBOXES];
    unsigned requests;
    struct bxcan_fifo fifos[2];
    struct bxcan_filters filters;
};

void bxcan_open(struct bxcan *can, struct can_wire *wire, unsigned bank_count);
        /* A controller on a wire, as after power-up, without faults. */

void bxcan_reset(struct bxcan *can);
        /* Resets it; registers without a defined reset value hold garbage. */

int bxcan_fifo_for(const struct bxcan *can, const struct frame *frame);
        /* The FIFO that the filters send a frame to, or -1. */

#endif
