/* reset_chip.h: restarts the program. */
#ifndef OCTET_RESET_CHIP_H
#define OCTET_RESET_CHIP_H

void reset_chip(void);
        /* Resets the chip. If that fails, the watchdog does it. */

#endif
