#include "hal/port/cortex_m/systick.h"

#include "hal/port/cortex_m/core.h"

enum {
    SPAN = 1 << 24,
    ON = 1,         /* from an eighth of the core's clock, no interrupt */
    DIVISOR = 8
};

static struct {
    uint32_t per_ms;   /* counts */
    uint32_t seen;     /* the timer, which counts down, as it was when the last whole millisecond ended */
    uint32_t ms;
} timer;                /* there is only one, and those who ask for the time have nowhere to keep it */

void systick_start(uint32_t core_hz)
{
    timer.per_ms = core_hz / DIVISOR / 1000u;
    timer.seen = 0;
    SYSTICK.load = SPAN - 1;
    SYSTICK.val = 0;
    SYSTICK.ctrl = ON;
}

uint32_t machine_ms(void)
{
    uint32_t passed = ((timer.seen - SYSTICK.val) & (SPAN - 1)) / timer.per_ms;

    timer.seen -= passed * timer.per_ms;
    timer.ms += passed;
    return timer.ms;
}
