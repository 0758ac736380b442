#include "hal/stm32/machine.h"

#include "hal/stm32/registers.h"

enum {
    SYSTICK_SPAN = 1 << 24,
    SYSTICK_ON = 1,              /* from an eighth of the core's clock, no interrupt */
    SYSTICK_DIVISOR = 8,
    WATCHDOG_UNLOCK = 0x5555,
    WATCHDOG_FEED = 0xAAAA,
    WATCHDOG_ON = 0xCCCC,
    WATCHDOG_BY_32 = 3,
    WATCHDOG_COUNTS = 2000,      /* 2 s at 32 kHz on an F4, 1.6 s at 40 kHz on an F1 */
    WATCHDOG_WAIT_MAX = 200000   /* looks: its clock is slow, the change takes up to 5 periods of it */
};

static struct {
    struct clocks clocks;
    uint32_t seen;   /* SysTick's value, which counts down, as of the last look */
    uint32_t rest;   /* counts that make no whole millisecond yet */
    uint32_t ms;
} machine;           /* there is one, and whoever asks for the time has no place to keep it */

/* First of all: whatever hangs from here on ends in a reset. Where the update does not end, the longest period stays. */
static void start_watchdog(void)
{
    IWDG.kr = WATCHDOG_ON;
    IWDG.kr = WATCHDOG_UNLOCK;
    IWDG.pr = WATCHDOG_BY_32;
    IWDG.rlr = WATCHDOG_COUNTS;
    for (unsigned i = 0; i < WATCHDOG_WAIT_MAX && IWDG.sr != 0; i++)
        continue;
    IWDG.kr = WATCHDOG_FEED;
}

static void start_time(void)
{
    SYSTICK.load = SYSTICK_SPAN - 1;
    SYSTICK.val = 0;
    SYSTICK.ctrl = SYSTICK_ON;
}

void machine_start(void)
{
    start_watchdog();
    machine.clocks = clock_start();
    pins_start();
    start_time();
}

struct clocks machine_clocks(void)
{
    return machine.clocks;
}

uint32_t machine_ms(void)
{
    uint32_t per_ms = machine.clocks.core_hz / SYSTICK_DIVISOR / 1000u;
    uint32_t now = SYSTICK.val;

    machine.rest += (machine.seen - now) & (SYSTICK_SPAN - 1);
    machine.seen = now;
    machine.ms += machine.rest / per_ms;
    machine.rest %= per_ms;
    return machine.ms;
}

void machine_feed(void)
{
    IWDG.kr = WATCHDOG_FEED;
}
