/* clock.h: the clocks of the core and of the serial port. */
#ifndef OCTET_RP2040_CLOCK_H
#define OCTET_RP2040_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

enum { CLOCK_CRYSTAL_MHZ = 12, CLOCK_WAIT_MAX = 100000 };   /* polls: some 50 ms by the slowest clock */

struct clocks {
    uint32_t core_hz;   /* of the serial port, too */
    bool exact;         /* false: the ring oscillator, whose frequency is anywhere from half to twice this */
};

struct clocks clock_start(void);
        /* 125 MHz from the crystal by the PLL, or what works: the crystal, or the ring oscillator. Each wait is
           bounded. */

bool clock_start_adc(void);
        /* The ADC's 48 MHz, by the other PLL. False: the crystal does not run. */

void clock_release(uint32_t blocks);
        /* Takes blocks out of reset, one bit of RESETS each, and waits until they are. */

#endif
