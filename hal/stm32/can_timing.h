/* can_timing.h: one bit of CAN, in quanta: periods of the controller's clock divided by a prescaler. */
#ifndef OCTET_CAN_TIMING_H
#define OCTET_CAN_TIMING_H

#include <stdint.h>

enum {
    CAN_BITRATE = OCTET_CAN_BITRATE,   /* bit/s, set by the build */
    CAN_QUANTA_AFTER = 2,   /* after the sample point, which is thus at 75..89 % of the bit */
    CAN_QUANTA_JUMP = 2     /* resynchronization jump width */
};

uint32_t can_quanta(uint32_t clock_hz, uint32_t bitrate);
        /* Quanta per bit, 8..18, for which an integer prescaler gives exactly that bit rate; each of our controllers
           supports these. 0: the clock has no such divisor. */

#endif
