#include "hal/port/cortex_m/leave.h"

#include "hal/port/cortex_m/core.h"

enum {
    AIRCR_KEY = 0x05FA << 16,
    AIRCR_RESET = 1 << 2
};

/* The reset takes a few cycles. The barrier makes compiler and core complete all earlier stores. */
void leave_by_reset(void)
{
    __asm__ volatile("dsb" ::: "memory");
    SCB.aircr = AIRCR_KEY | AIRCR_RESET;
    for (;;)
        continue;
}

void leave_to(const uint32_t vectors[])
{
    SYSTICK.ctrl = 0;
    SCB.vtor = (uint32_t)(uintptr_t)vectors;
    __asm__ volatile("dsb\n\t"
                     "isb\n\t"
                     "msr msp, %0\n\t"
                     "bx %1" ::"r"(vectors[0]), "r"(vectors[1]) : "memory");
}
