/* machine.h: the state of the microcontroller for the drivers: its clocks, and the time. */
#ifndef OCTET_MACHINE_H
#define OCTET_MACHINE_H

#include "hal/port/cortex_m/systick.h"
#include "hal/stm32/chip.h"

struct clocks machine_clocks(void);
        /* As they run now. */

#endif
