/* systick.h: time, from the SysTick timer of every Cortex-M. */
#ifndef OCTET_SYSTICK_H
#define OCTET_SYSTICK_H

#include <stdint.h>

void systick_start(uint32_t core_hz, uint32_t divisor);
        /* Starts the time, with the divisor of mcu_systick_divisor. Call again when the core clock has changed. */

uint32_t machine_ms(void);
        /* Milliseconds since systick_start; wraps. Call at least every 2^24 counts (0.7 s on an STM32F405), or it
           falls behind. */

#endif
