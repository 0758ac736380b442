/* leave.h: two ways to end a program. Neither returns. */
#ifndef OCTET_LEAVE_H
#define OCTET_LEAVE_H

#include <stdint.h>

void leave_by_reset(void);
        /* Resets the chip. If that fails, the watchdog does it. */

void leave_to(const uint32_t vectors[]);
        /* Jumps to another program by its vector table. Call with the clocks as after a reset. */

#endif
