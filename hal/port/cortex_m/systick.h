/* systick.h: time, from the timer that every Cortex-M has. */
#ifndef OCTET_SYSTICK_H
#define OCTET_SYSTICK_H

#include <stdint.h>

void systick_start(uint32_t core_hz);
        /* Time passes from here on. To be called again when the core's clock has changed. */

uint32_t machine_ms(void);
        /* Milliseconds since systick_start; wraps. To be asked at least every 0.7 s, else it falls behind. */

#endif
