/* fdcan_model.h: FDCAN as its manual has it, behind registers and message RAM in RAM. It looks at them, and time passes, whenever
 * the driver asks for the time. */
#ifndef OCTET_FDCAN_MODEL_H
#define OCTET_FDCAN_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/link/link.h"
#include "hal/stm32/machine.h"

enum {
    MODEL_SENT_MAX = 64,
    MODEL_FIFO_DEPTH = 3,
    MODEL_LOOK_US = 50,        /* from one look at the clock to the next */
    MODEL_RECOVERY_US = 3000   /* 129 times 11 bits at 500 kbit/s, and a little */
};

struct fdcan_model {
    struct clocks clocks;
    uint32_t now_us;

    bool ignores_init;         /* INIT is never read back */
    bool bus_busy;             /* nothing can be sent, and the bus cannot be joined */
    uint32_t occupied_by;      /* identifier that others send without a pause; 0: nobody does */
    uint32_t frame_us;         /* that a frame takes on the wire */
    bool sticks;               /* what waits neither leaves nor is given up */
    bool bus_off;
    bool stays_off;            /* the idle times that end bus-off never come */
    bool joined;
    bool recovering;
    uint32_t recovering_us;
    unsigned inits;            /* times that init was entered */
    unsigned bus_offs_recovered;
    bool in_init;

    struct frame sent[MODEL_SENT_MAX];
    unsigned sent_count;
    int on_wire;               /* buffer whose frame the wire carries, or -1 */
    uint32_t on_wire_us;       /* since when */

    struct {
        unsigned first, waiting;   /* of the elements */
        bool lost;
    } fifos[2];
};

extern struct fdcan_model fdcan;

void fdcan_reset(void);
        /* As after a reset, with garbage wherever the manual promises nothing. */

void fdcan_step(void);
        /* Looks at the registers, as each machine_ms does, but no time passes. */

void fdcan_bring(const struct frame *frame);
        /* A frame arrives, in FIFO 0 if no filter has a place for it. A fourth one is lost. */

int fdcan_fifo_for(uint32_t id);
        /* The FIFO that the filters send a data frame with this standard identifier to, or -1. */

#endif
