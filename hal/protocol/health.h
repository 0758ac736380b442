/* health.h: the state of the machine under the robot: why it last started, and how it last crashed. */
#ifndef OCTET_HEALTH_H
#define OCTET_HEALTH_H

#include <stdbool.h>

#include "hal/link/link.h"

enum reset_cause {
    RESET_POWER_ON,   /* power-on, or a power failure */
    RESET_PIN,        /* the reset button, or a debugger */
    RESET_WATCHDOG,   /* it hung */
    RESET_SOFTWARE,   /* its body could not be opened */
    RESET_CRASH       /* a fault exception: see struct crash */
};

enum { CRASH_VALUES_MAX = 13 };   /* that octet.dbc has names for */

/* The machine's state when it crashed, in values named by octet.dbc; only the port knows what they mean. */
struct crash {
    uint8_t cause;
    uint8_t count;                      /* of values, 1..CRASH_VALUES_MAX */
    uint32_t values[CRASH_VALUES_MAX];  /* a value's index is its name in octet.dbc */
};

struct health {
    enum reset_cause reset_cause;
    bool unstored;      /* the newest memory waits to be stored */
    bool clock_exact;   /* the clock is as exact as the bus needs */
    struct link_health bus;
    const struct crash *crash;   /* null for none */
};

#endif
