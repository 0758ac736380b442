/* health.h: how the machine under the robot fares: why it last started, and what it last died of. */
#ifndef OCTET_HEALTH_H
#define OCTET_HEALTH_H

#include "hal/hal.h"
#include "hal/link/link.h"

enum reset_cause {
    RESET_POWER_ON,   /* or a power failure */
    RESET_PIN,        /* the reset button, or a debugger */
    RESET_WATCHDOG,   /* it hung */
    RESET_SOFTWARE,   /* its body could not be opened */
    RESET_CRASH       /* it did what it must not: see struct crash */
};

/* Numbers as a Cortex-M has them. */
enum crash_cause { CRASH_NMI = 2, CRASH_HARD_FAULT, CRASH_MEMORY_FAULT, CRASH_BUS_FAULT, CRASH_USAGE_FAULT };

enum crash_register {
    CRASH_PC, CRASH_LR, CRASH_PSR, CRASH_SP, CRASH_R0, CRASH_R1, CRASH_R2, CRASH_R3, CRASH_R12,
    CRASH_CFSR, CRASH_HFSR, CRASH_MMFAR, CRASH_BFAR,
    CRASH_REGISTER_COUNT
};

struct crash {
    uint32_t cause;                             /* an enum crash_cause, or the number of another exception */
    uint32_t registers[CRASH_REGISTER_COUNT];   /* as they were when it happened */
};

struct health {
    enum reset_cause reset_cause;
    struct link_health bus;
    const struct crash *crash;   /* null for none */
};

#endif
