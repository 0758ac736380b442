#include "hal/port/cortex_m/reset_chip.h"

#include "hal/port/cortex_m/core.h"

enum {
    AIRCR_KEY = 0x05FA << 16,
    AIRCR_RESET = 1 << 2
};

/* A chip may have its own. The reset takes a few cycles. The barrier completes all earlier stores of compiler and
 * core. */
__attribute__((weak)) void reset_chip(void)
{
    __asm__ volatile("dsb" ::: "memory");
    SCB.aircr = AIRCR_KEY | AIRCR_RESET;
    for (;;)
        continue;
}
