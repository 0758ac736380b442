/* machine.h: the running microcontroller: its clocks and its time. */
#ifndef OCTET_MACHINE_H
#define OCTET_MACHINE_H

#include "hal/stm32/chip.h"

void machine_start(void);
        /* Watchdog, clocks, pins and time, in this order. */

struct clocks machine_clocks(void);
        /* As they run now. */

uint32_t machine_ms(void);
        /* Milliseconds since machine_start; wraps. To be asked at least every 0.7 s, else it falls behind. */

void machine_feed(void);
        /* Without this the watchdog resets the machine after 2 s, give or take a third. */

#endif
