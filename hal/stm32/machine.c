/* The microcontroller functions of the port on an STM32. */
#include "hal/port/cortex_m/mcu.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/registers.h"

enum {
    WATCHDOG_UNLOCK = 0x5555,
    WATCHDOG_FEED = 0xAAAA,
    WATCHDOG_ON = 0xCCCC,
    WATCHDOG_BY_32 = 3,
    WATCHDOG_COUNTS = 2000,      /* data sheets: 1.07..2.13 s on F103, 1.36..3.76 s on F405, 1.88..2.17 s on G431 */
    WATCHDOG_WAIT_MAX = 200000   /* polls; the change takes up to 5 periods of the slow clock */
};

enum {                           /* in RCC_CSR: RM0008 7.3.10, RM0090 7.3.21, RM0440 7.4.28 */
    FLAG_PIN = 1 << 26,
    FLAG_SOFTWARE = 1 << 28,
    FLAG_WATCHDOGS = 3 << 29
};

static struct clocks clocks;     /* one machine per program */

/* Called first, so that any hang ends in a reset. If the update does not complete, the longest period remains. */
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

uint32_t mcu_start(void)
{
    start_watchdog();
    clocks = clock_start();
    pins_start();
    return clocks.core_hz;
}

uint32_t mcu_systick_divisor(void)
{
    return CLOCK_SYSTICK_DIVISOR;
}

bool mcu_clock_is_exact(void)
{
    return clocks.exact;
}

struct clocks machine_clocks(void)
{
    return clocks;
}

void mcu_feed(void)
{
    IWDG.kr = WATCHDOG_FEED;
}

/* Every reset also sets the pin's flag. */
enum reset_cause mcu_reset_cause(void)
{
    uint32_t flags = chip_reset_flags();

    if (flags & CHIP_POWER_ON)
        return RESET_POWER_ON;
    if (flags & FLAG_WATCHDOGS)
        return RESET_WATCHDOG;
    if (flags & FLAG_SOFTWARE)
        return RESET_SOFTWARE;
    return flags & FLAG_PIN ? RESET_PIN : RESET_POWER_ON;
}
