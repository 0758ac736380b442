/* mcu.h: what the port needs of the microcontroller around the core. Each chip family has it: hal/stm32 is one. */
#ifndef OCTET_MCU_H
#define OCTET_MCU_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/protocol/health.h"

uint32_t mcu_start(void);
        /* Starts watchdog, clocks and pins, in this order, and returns the core clock in Hz. Each wait is bounded. */

uint32_t mcu_systick_divisor(void);
        /* 1: SysTick counts the core clock, as every Cortex-M can. Else it counts the chip's reference, which is the
           core clock divided by this: 8 on an STM32. */

bool mcu_clock_is_exact(void);
        /* Whether the clock that mcu_start found comes from a crystal: the bus needs it. */

enum reset_cause mcu_reset_cause(void);
        /* What has reset the chip since the last call. A reset requested by the core is RESET_SOFTWARE. */

void reset_chip(void);
        /* Restarts the program: resets the chip. If that fails, the watchdog does it. The port has one by the core's
           own request; a chip may have its own. */

void mcu_feed(void);
        /* Feeds the watchdog, which otherwise resets the chip after 1 to 4 s. */

void mcu_light(bool on);
        /* Switches the board's LED. */

#endif
