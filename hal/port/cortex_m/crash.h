/* crash.h: records a crash (a fault exception) across the reset that follows it. */
#ifndef OCTET_CRASH_H
#define OCTET_CRASH_H

#include "hal/protocol/health.h"

enum {
    CRASH_FRAME_WORDS = 8   /* pushed by the core on an exception: r0..r3, r12, lr, pc, psr */
};

/* The exceptions that end a program, by the core's exception numbers. */
enum crash_cause { CRASH_NMI = 2, CRASH_HARD_FAULT, CRASH_MEMORY_FAULT, CRASH_BUS_FAULT, CRASH_USAGE_FAULT };

/* The values of a struct crash, in this order. */
enum crash_register {
    CRASH_PC, CRASH_LR, CRASH_PSR, CRASH_SP, CRASH_R0, CRASH_R1, CRASH_R2, CRASH_R3, CRASH_R12,
    CRASH_CFSR, CRASH_HFSR, CRASH_MMFAR, CRASH_BFAR,
    CRASH_REGISTER_COUNT
};

void crash_keep(uint32_t cause, const uint32_t *frame, const uint32_t *lowest, const uint32_t *end);
        /* Records the state at an exception in RAM that survives a reset. Reads frame only if it lies within
           lowest..end, which has room for one. Called from the exception handler, just before the reset. */

enum reset_cause crash_reset_cause(enum reset_cause cause);
        /* The reason for the last start: RESET_CRASH if a crash came before the reset, else the reason that the chip
           gives. Call once, at start. */

const struct crash *crash_last(void);
        /* The last crash since power-up, or null. */

#endif
