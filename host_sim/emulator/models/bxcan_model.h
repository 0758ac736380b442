/* bxcan_model.h: the bxCAN controller (RM0090 chapter 32, RM0008 chapter 24), as a driver that polls sees it. What the
 * manual forbids, and what is not modelled, is refused with a reason. Python reads this header too. */
#ifndef OCTET_BXCAN_MODEL_H
#define OCTET_BXCAN_MODEL_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/emulator/models/can_wire.h"

enum {
    BXCAN_MAILBOXES = 3,
    BXCAN_FIFO_DEPTH = 3,
    BXCAN_BANKS_MAX = 28,
    BXCAN_REFUSAL_MAX = 96
};

enum bxcan_mode { BXCAN_NORMAL = 0, BXCAN_INIT = 1, BXCAN_SLEEP = 2 };   /* as MSR tells */

enum bxcan_error { BXCAN_NO_ACKNOWLEDGE = 3, BXCAN_BIT_DOMINANT = 5 };   /* as ESR tells: LEC */

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
    unsigned overruns;     /* frames lost so far */
    uint64_t release_ns;   /* when RFOM has done its work */
};

struct bxcan_filters {
    uint32_t words[16];    /* FMR, FM1R, -, FS1R, -, FFA1R, -, FA1R, - */
    uint32_t banks[2 * BXCAN_BANKS_MAX];
};

struct bxcan {
    uint32_t clock_hz;         /* that the bit timing divides */
    bool clocked;              /* whether it has a clock at all: without one no register can be reached */
    unsigned bank_count;
    bool init_stuck;           /* faults: INAK never comes; */
    bool release_slow;         /* a released frame shows on for 0.1 ms, as RFOM tells; */
    bool recovery_stuck;       /* bus-off never ends; */
    unsigned stuck_mailboxes;  /* bit n: mailbox n neither sends nor gives up */
    char refusal[BXCAN_REFUSAL_MAX];   /* why something was refused; empty: nothing was */

    struct can_wire *wire;
    uint32_t mcr, btr, ier;
    enum bxcan_mode mode, wanted;
    unsigned inits;            /* times that init was entered */
    uint64_t mode_ns;          /* when the wanted mode is entered */
    uint64_t recovery_ns;      /* when bus-off is over */
    unsigned tec, rec;         /* error counters */
    unsigned last_error;
    bool bus_off;
    struct bxcan_mailbox mailboxes[BXCAN_MAILBOXES];
    int on_wire;               /* mailbox whose frame the wire carries, or -1 */
    unsigned requests;
    struct bxcan_fifo fifos[2];
    struct bxcan_filters filters;
};

void bxcan_open(struct bxcan *can, struct can_wire *wire, unsigned bank_count);
        /* A controller on a wire, as after power-up, without faults. */

void bxcan_reset(struct bxcan *can);
        /* As after a reset; garbage wherever the manual promises nothing. */

int64_t bxcan_read(struct bxcan *can, uint32_t offset);
        /* What a register holds, or -1: refused. Reading changes nothing. */

bool bxcan_write(struct bxcan *can, uint32_t offset, uint32_t value);
        /* False: refused. What follows from it does so when time passes on the wire. */

int bxcan_fifo_for(const struct bxcan *can, const struct frame *frame);
        /* The FIFO that the filters send a frame to, or -1. */

/* What the wire asks of a controller. */
bool bxcan_listens(const struct bxcan *can);
bool bxcan_offer(struct bxcan *can, struct frame *out);
void bxcan_lost_arbitration(struct bxcan *can);
void bxcan_sent(struct bxcan *can);
void bxcan_failed(struct bxcan *can, enum bxcan_error error);
void bxcan_arrived(struct bxcan *can, const struct frame *frame, bool destroyed);
uint64_t bxcan_advance(struct bxcan *can);

#endif
