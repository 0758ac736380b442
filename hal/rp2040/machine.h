/* machine.h: what the drivers of an RP2040 ask of each other, and the pins of the board that this is built for. */
#ifndef OCTET_RP2040_MACHINE_H
#define OCTET_RP2040_MACHINE_H

#include <stdbool.h>
#include <stdint.h>

#include "board_pins.h"   /* BOARD_LED and its like, made by tools/pins */

/* The clocks of the core and of the serial port. */

enum { CLOCK_CRYSTAL_MHZ = 12, CLOCK_WAIT_MAX = 100000 };   /* polls: some 50 ms by the slowest clock */

struct clocks {
    uint32_t core_hz;   /* of the serial port, too */
    bool exact;         /* false: the ring oscillator, whose frequency is anywhere from half to twice this */
};

struct clocks machine_clocks(void);
        /* As they run now. */

struct clocks clock_start(void);
        /* 125 MHz from the crystal by the PLL, or what works: the crystal, or the ring oscillator. Each wait is
           bounded. */

bool clock_start_adc(void);
        /* The ADC's 48 MHz, by the other PLL. False: the crystal does not run. */

void clock_release(uint32_t blocks);
        /* Takes blocks out of reset, one bit of RESETS each, and waits until they are. */

/* One pin at a time. */

enum gpio_function { GPIO_UART = 2, GPIO_BY_PWM = 4, GPIO_BY_CORE = 5 };   /* data sheet 1.4.3 */

void gpio_set(uint32_t pin, enum gpio_function function);
        /* Connects a pin to what drives or reads it, pulled up while nothing drives it. */

void gpio_analogue(uint32_t pin);
        /* Disconnects all but the ADC from a pin. */

void gpio_output(uint32_t pin);
void gpio_write(uint32_t pin, bool high);
bool gpio_read(uint32_t pin);
        /* For a pin of GPIO_BY_CORE. */

/* The boot ROM's functions for the flash (data sheet 2.8.3). While one works, the flash cannot be read: so what calls
 * them runs from RAM. No interrupt is ever taken, and the other core sleeps in the ROM. */

enum { ROM_SECTOR = 4096, ROM_PAGE = 256 };   /* what is erased at once, and written at once, in bytes */

bool rom_exists(void);
        /* False where the ROM's table is not there, as in some emulators. Then nothing else here may be called. */

void rom_erase(uint32_t offset);
        /* Erases the sector at that offset in the flash, in some 50 ms, at most 400 ms. */

void rom_write(uint32_t offset, const uint32_t page[ROM_PAGE / 4]);
        /* Clears the bits of a page that are 0 in page, which lies in RAM; in some 0.5 ms, at most 3 ms. */

#endif
