/* chip.h: what each chip does in its own way. Its folder has pins_start and mcu_light, the functions of flash.h, the table of
 * clock.h, its registers, its linker script, and chip.cmake, which names its links and the shared drivers in them. */
#ifndef OCTET_CHIP_H
#define OCTET_CHIP_H

#include <stdbool.h>
#include <stdint.h>

struct clocks {
    uint32_t core_hz;
    uint32_t can_hz;     /* of the CAN controller */
    uint32_t usart_hz;   /* of the serial port */
    bool exact;          /* false: from the internal oscillator, good to 1 % */
};

struct clocks clock_start(void);
        /* The fastest clock that comes up: crystal and PLL, else internal oscillator and PLL, else the internal
           oscillator as it is. Each wait has a bound: a few milliseconds in all with a crystal that starts as it should,
           0.12 s at the most. Leaves systick at the speed after reset. */

uint32_t chip_reset_flags(void);
        /* RCC_CSR: what has reset the chip since the last call. */

void pins_start(void);
        /* Power for all peripherals in use, and a watch over the supply, for flash.h; the pins of the board's LED, CAN and
           serial port as such. */

#endif
