/* chip.h: what each chip implements for itself. Its folder has pins_start and mcu_light, the functions of flash.h,
 * the table of clock.h, registers, linker script, and chip.cmake, which names its links and their shared drivers. */
#ifndef OCTET_CHIP_H
#define OCTET_CHIP_H

#include <stdbool.h>
#include <stdint.h>

struct clocks {
    uint32_t core_hz;
    uint32_t can_hz;     /* of the CAN controller */
    uint32_t usart_hz;   /* of the serial port */
    bool exact;          /* false: internal oscillator, 1 % accurate */
};

enum { CLOCK_SYSTICK_DIVISOR = 8 };   /* RM0008 and its like: longer between two looks than by the core clock */

struct clocks clock_start(void);
        /* Starts the best clock that works: crystal and PLL, else internal oscillator and PLL, else the internal
           oscillator alone. Each wait is bounded: a few milliseconds in all with a good crystal, 0.12 s at most.
           Leaves systick set for the clock after reset. */

enum { CHIP_POWER_ON = 1 << 27 };   /* in RCC_CSR: RM0008 7.3.10, RM0090 7.3.21, RM0440 7.4.28 */

uint32_t chip_reset_flags(void);
        /* RCC_CSR: what has reset the chip since the last call; a brown-out counts as CHIP_POWER_ON. */

void pins_start(void);
        /* Enables the clocks of all peripherals in use, monitors the supply for flash.h, and sets up the pins of the
           board's LED, CAN and serial port. */

#endif
