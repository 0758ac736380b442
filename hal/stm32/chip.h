/* chip.h: what one chip does in its own way. Each has its folder with these, its registers and its linker script. */
#ifndef OCTET_CHIP_H
#define OCTET_CHIP_H

#include <stdbool.h>
#include <stdint.h>

struct clocks {
    uint32_t core_hz;
    uint32_t can_hz;     /* of bxCAN, APB1 */
    uint32_t usart_hz;   /* of USART1, APB2 */
    bool exact;          /* false: from the internal oscillator, good to 1 % */
};

struct clocks clock_start(void);
        /* The fastest clock that comes up: crystal and PLL, else internal oscillator and PLL, else the internal
           oscillator as it is. Each wait has a bound; a few milliseconds in all. */

uint32_t chip_reset_flags(void);
        /* RCC_CSR: what has reset the chip since the last call. */

void pins_start(void);
        /* Power for all peripherals in use; the board's LED, CAN and USART1 pins as such. */

void pins_light(bool on);
        /* The board's LED. */

#endif
