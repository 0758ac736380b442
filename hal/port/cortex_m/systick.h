/* systick.h: time, from the SysTick timer of every Cortex-M. */
#ifndef OCTET_SYSTICK_H
#define OCTET_SYSTICK_H

#include <stdint.h>

void systick_start(uint32_t core_hz);
        /* Starts the time. Call again when the core clock has changed. */

uint32_t machine_ms(void);
        /* Milliseconds since systick_start; wraps. Call at least every 0.7 s, or it falls behind. */

#endif
