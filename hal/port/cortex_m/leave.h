/* leave.h: ends a program. */
#ifndef OCTET_LEAVE_H
#define OCTET_LEAVE_H

void leave_by_reset(void);
        /* Resets the chip. If that fails, the watchdog does it. */

#endif
