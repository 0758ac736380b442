/* bxcan_model.h: bxCAN as its manual has it, behind registers in RAM. It looks at them, and time passes, whenever the driver
 * asks for the time. */
#ifndef OCTET_BXCAN_MODEL_H
#define OCTET_BXCAN_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/link/link.h"
#include "hal/stm32/machine.h"

enum {
    MODEL_SENT_MAX = 64,
    MODEL_WAITING_MAX = 64,
    MODEL_FIFO_DEPTH = 3,
    MODEL_LOOK_US = 50,        /* from one look at the clock to the next */
    MODEL_RECOVERY_US = 3000   /* 128 times 11 bits at 500 kbit/s, and a little */
};

struct bxcan_model {
    struct clocks clocks;
    uint32_t now_us;

    bool ignores_init;         /* INAK never comes */
    bool releases_slowly;      /* the FIFO shows a frame on for one look after its release, as RFOM tells */
    bool releasing;
    bool bus_busy;             /* nothing can be sent, and init cannot be left */
    bool bus_off;
    bool stays_off;            /* the idle times that end bus-off never come */
    unsigned inits;            /* times that init was entered */
    unsigned bus_offs_recovered;

    struct frame sent[MODEL_SENT_MAX];
    unsigned sent_count;
    unsigned aborted;

    struct frame waiting[MODEL_WAITING_MAX];   /* frames in the FIFO, the first in the registers */
    unsigned waiting_count;
    bool overrun;

    bool pending[3];
    unsigned request[3];       /* which request it was, in order of time */
    unsigned requests;
    uint32_t fifo_shown;       /* RF0R as last shown: another value was written by the driver */
    uint32_t recovering_us;
    bool recovering;
};

extern struct bxcan_model bxcan;

void bxcan_reset(void);
        /* As after a reset, with garbage wherever the manual promises nothing. */

void bxcan_step(void);
        /* Looks at the registers, as each machine_ms does, but no time passes. */

void bxcan_bring(const struct frame *frame);
        /* A frame arrives that the filters let through. A fourth one is lost, and is an overrun. */

bool bxcan_filter_passes(uint32_t id);
        /* Would the filters let a data frame with this standard identifier through? */

#endif
