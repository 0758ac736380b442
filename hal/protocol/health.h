/* health.h: the state of the machine under the robot: why it last started, and how it last crashed. */
#ifndef OCTET_HEALTH_H
#define OCTET_HEALTH_H

#include <stdbool.h>

#include "hal/link/link.h"

enum reset_cause {
    RESET_POWER_ON,   /* or a power failure */
    RESET_PIN,        /* the reset button, or a debugger */
    RESET_WATCHDOG,   /* it hung */
    RESET_SOFTWARE,   /* its body could not be opened */
    RESET_CRASH       /* it did what it must not: see struct crash */
};

enum { CRASH_VALUES_MAX = 13 };   /* that octet.dbc has names for */

/* What the machine knew when it crashed, in numbers that octet.dbc has words for; only the port knows what they mean. */
struct crash {
    uint8_t cause;
    uint8_t count;                      /* of values, 1..CRASH_VALUES_MAX */
    uint32_t values[CRASH_VALUES_MAX];  /* the name of a value is its place */
};

struct health {
    enum reset_cause reset_cause;
    bool unstored;      /* what was learned last waits to be stored */
    bool clock_exact;   /* the clock is as exact as the bus needs */
    struct link_health bus;
    const struct crash *crash;   /* null for none */
};

#endif
