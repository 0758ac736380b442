/* mcu.h: what the port needs of the microcontroller around the core. Each family of chips provides it: hal/stm32 is one. */
#ifndef OCTET_MCU_H
#define OCTET_MCU_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/protocol/health.h"

uint32_t mcu_start(void);
        /* Watchdog, clocks and pins, in this order; returns the core's clock in Hz. Each wait has a bound. */

bool mcu_clock_is_exact(void);
        /* Whether the clock that mcu_start found comes from a crystal: the bus needs it. */

enum reset_cause mcu_reset_cause(void);
        /* What has reset the chip since the last call. A reset that the core asked for is RESET_SOFTWARE. */

void mcu_feed(void);
        /* Without this the watchdog resets the chip, after 1 to 4 s. */

void mcu_be_patient(void);
        /* From here on until mcu_start, the watchdog waits four times as long: longer than the erase of any part of the flash,
           during which the core stands still. */

void mcu_light(bool on);
        /* The board's LED. */

#endif
