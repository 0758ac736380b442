#include "hal/port/cortex_m/systick.h"

#include "hal/port/cortex_m/core.h"

enum {
    SPAN = 1 << 24,
    ON = 1,         /* without interrupt */
    BY_CORE = 4     /* clocked by the core clock, else by the chip's reference */
};

static struct {
    uint32_t per_ms;   /* counts */
    uint32_t seen;     /* value of the down-counting timer at the end of the last whole millisecond */
    uint32_t ms;
} timer;                /* the only timer; its callers have no place for its state */

void systick_start(uint32_t core_hz, uint32_t divisor)
{
    timer.per_ms = core_hz / divisor / 1000u;
    timer.seen = 0;
    SYSTICK.load = SPAN - 1;
    SYSTICK.val = 0;
    SYSTICK.ctrl = divisor == 1 ? ON | BY_CORE : ON;
}

uint32_t machine_ms(void)
{
    uint32_t passed = ((timer.seen - SYSTICK.val) & (SPAN - 1)) / timer.per_ms;

    timer.seen -= passed * timer.per_ms;
    timer.ms += passed;
    return timer.ms;
}
