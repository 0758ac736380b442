/* clock.h: what clock.c needs to know of a chip. Notation as in registers.h. */
#ifndef OCTET_CLOCK_H
#define OCTET_CLOCK_H

#include "hal/stm32/chip.h"

struct clock_source {
    uint32_t pll;            /* the PLL's setting with this source */
    struct clocks clocks;    /* the resulting clocks */
};

struct clock_table {
    volatile uint32_t *cr, *cfgr, *pll, *csr, *acr;   /* of RCC, the one that sets up the PLL, and of the flash */
    uint32_t on_after_reset; /* a bit of CR that is never 0 on the chip itself, or 0 */
    uint32_t forget;         /* in CSR: clears the flags */
    uint32_t brown_out;      /* in CSR: the flag of a brown-out, if power-on does not cover it */
    uint32_t internal;       /* CFGR: the internal oscillator alone */
    uint32_t buses;          /* CFGR: the same, with buses slow enough for the PLL, if its setting does not say so */
    uint32_t switch_to_pll;  /* CFGR: SW */
    uint32_t from_pll;       /* CFGR: SWS */
    uint32_t caches;         /* ACR, and the wait states in it */
    uint32_t waits_mask;
    uint32_t waits;
};

/* In the chip's clock.c. */
extern const struct clock_table CLOCK_TABLE;
extern const struct clock_source CLOCK_SOURCES[2];   /* the internal oscillator, the crystal */
extern const struct clocks CLOCK_SLOW;   /* the internal oscillator alone */

enum {
    CRYSTAL_MS = 100,        /* most start in 2 ms; the vendor's code allows as much */
    SWITCH_MS = 5            /* a PLL locks in 0.3 ms; a switch takes a few cycles */
};

#endif
