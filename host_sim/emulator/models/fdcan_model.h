/* fdcan_model.h: FDCAN (RM0440 44) with its message RAM, as a polling driver sees it: classic CAN, buffers as a queue
 * by identifier. Accesses that the manual forbids or that are not modelled are refused with a reason. Python reads
 * this header too. */
#ifndef OCTET_FDCAN_MODEL_H
#define OCTET_FDCAN_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/emulator/models/can_node.h"

enum {
    FDCAN_BUFFERS = 3,
    FDCAN_RAM_AT = 0x4000,     /* offset of the message RAM from the registers */
    FDCAN_RAM_WORDS = 212
};

struct fdcan_fifo_state {
    unsigned first, count;     /* of the elements, which are a ring */
};

struct fdcan {
    struct can_node node;
    uint32_t cccr, nbtp, rxgfc, txbc, ir;
    uint32_t pending, aborting;            /* bit n: buffer n */
    uint32_t sent, given_up;               /* TXBTO, TXBCF */
    struct fdcan_fifo_state fifos[2];
    uint32_t ram[FDCAN_RAM_WORDS];
};

void fdcan_open(struct fdcan *can, struct can_wire *wire);
        /* A controller on a wire, as after power-up, without faults. */

void fdcan_reset(struct fdcan *can);
        /* Resets it; the message RAM keeps its contents, which are garbage after power-up. */

int fdcan_fifo_for(struct fdcan *can, const struct frame *frame, unsigned *filter);
        /* The FIFO that the filters send a frame to, or -1; and the number of the filter, if one has matched. */

#endif
