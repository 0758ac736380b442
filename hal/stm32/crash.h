/* crash.h: what becomes of a robot that does what it must not, and how it knows of it afterwards. */
#ifndef OCTET_CRASH_H
#define OCTET_CRASH_H

#include "hal/protocol/health.h"

enum {
    CRASH_FRAME_WORDS = 8   /* what the core pushes when an exception comes: r0..r3, r12, lr, pc, psr */
};

void crash_keep(uint32_t cause, const uint32_t *frame, const uint32_t *lowest, const uint32_t *end);
        /* Notes what an exception found, in RAM that a reset leaves alone. frame is read only if it lies within
           lowest..end. */

enum reset_cause crash_reset_cause(uint32_t reset_flags);
        /* Why the machine last started, by RCC_CSR. To be called once, at start. */

const struct crash *crash_last(void);
        /* The last crash since power-up, or null. */

#endif
