/* The microcontroller functions of the port on an RP2040. */
#include "hal/rp2040/machine.h"

#include "hal/port/cortex_m/mcu.h"
#include "hal/rp2040/registers.h"

enum {
    RESETS_ALL = 0x1FFFC,        /* all but the oscillators; one bit for each block of the power-on state machine */
    WATCHDOG_TICK = CLOCK_CRYSTAL_MHZ | 1 << 9,   /* a microsecond, once clk_ref is the crystal */
    WATCHDOG_LOAD = 2 * 2000000, /* 2 s: each tick counts twice, RP2040-E1 */
    WATCHDOG_ON = 1 << 30,
    REASON_TIMER = 1 << 0,
    REASON_FORCED = 1 << 1,
    HAD_RUN = 1 << 16,           /* in chip_reset: by the pin RUN */
    RELEASED = 1 << 5 | 1 << 8 | 1 << 22   /* IO_BANK0, PADS_BANK0, UART0 */
};

static struct clocks clocks;     /* one machine per program */

/* Called first, so that any hang ends in a reset. */
static void start_watchdog(void)
{
    PSM.wdsel = RESETS_ALL;
    WATCHDOG.tick = WATCHDOG_TICK;
    WATCHDOG.load = WATCHDOG_LOAD;
    WATCHDOG.ctrl = WATCHDOG_ON;
}

uint32_t mcu_start(void)
{
    start_watchdog();
    clocks = clock_start();
    clock_release(RELEASED);
    gpio_output(BOARD_LED);
    gpio_set(BOARD_UART_TX, (enum gpio_function)BOARD_UART_TX_FUNCTION);
    gpio_set(BOARD_UART_RX, (enum gpio_function)BOARD_UART_RX_FUNCTION);
    return clocks.core_hz;
}

uint32_t mcu_systick_divisor(void)
{
    return 1;
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
    WATCHDOG.load = WATCHDOG_LOAD;
}

void mcu_light(bool on)
{
    gpio_write(BOARD_LED, on == BOARD_LED_HIGH);
}

enum reset_cause mcu_reset_cause(void)
{
    uint32_t reason = WATCHDOG.reason;

    if (reason & REASON_FORCED)
        return RESET_SOFTWARE;
    if (reason & REASON_TIMER)
        return RESET_WATCHDOG;
    return CHIP_RESET.chip_reset & HAD_RUN ? RESET_PIN : RESET_POWER_ON;
}
