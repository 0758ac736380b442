/* can_timing.h: one bit of CAN, in quanta: periods of the controller's clock divided by a prescaler. */
#ifndef OCTET_CAN_TIMING_H
#define OCTET_CAN_TIMING_H

#include <stdint.h>

enum {
    CAN_BITRATE = OCTET_CAN_BITRATE,   /* as the build was told */
    CAN_QUANTA_AFTER = 2,   /* behind the sample point, which is thus at 75..89 % of the bit */
    CAN_QUANTA_JUMP = 2     /* that a bit may grow or shrink by to keep step with the other nodes */
};

uint32_t can_quanta(uint32_t clock_hz, uint32_t bitrate);
        /* Quanta of a bit, 8..18, such that a whole prescaler makes exactly that bit rate; every controller of ours can do
           that. 0: the clock has no such divisor. */

#endif
