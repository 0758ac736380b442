/* leave.h: two ways in which a program ends. Neither returns. */
#ifndef OCTET_LEAVE_H
#define OCTET_LEAVE_H

#include <stdint.h>

void leave_by_reset(void);
        /* Resets the chip. If that fails, the watchdog does it. */

void leave_to(const uint32_t vectors[]);
        /* Goes on with another program, by its vectors, as after a reset: to be called with the clocks as after one. */

#endif
