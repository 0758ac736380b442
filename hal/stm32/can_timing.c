#include "hal/stm32/can_timing.h"

enum { QUANTA_MIN = 8, QUANTA_MAX = 18 };

/* The maximum number of quanta per bit: finer quanta improve synchronisation. */
uint32_t can_quanta(uint32_t clock_hz, uint32_t bitrate)
{
    for (uint32_t quanta = QUANTA_MAX; quanta >= QUANTA_MIN; quanta--)
        if (clock_hz % (bitrate * quanta) == 0)
            return quanta;
    return 0;
}
