/* A port to the mps2-an385, a Cortex-M3 that QEMU emulates. Fill in the blanks for a chip of yours. */
#include "hal/port/cortex_m/mcu.h"
#include "hal/port/cortex_m/uart.h"

enum { CORE_HZ = 25000000, FULL = 1, RECEIVED = 2, BOTH_WAYS = 3 };

extern volatile struct { uint32_t data, state, ctrl, lost, divisor; } UART;

uint32_t mcu_start(void)
{
    /* Start your watchdog, then your clocks, then your pins. */
    return CORE_HZ;
}

uint32_t mcu_systick_divisor(void) { return 1; }
bool mcu_clock_is_exact(void) { return true; }
enum reset_cause mcu_reset_cause(void) { return RESET_POWER_ON; /* Ask your chip. */ }
void mcu_feed(void) { /* Feed your watchdog. */ }
void mcu_light(bool on) { (void)on; /* Switch your LED. */ }

void uart_start(uint32_t baud)
{
    UART.divisor = CORE_HZ / baud;
    UART.ctrl = BOTH_WAYS;
}

void uart_stop(void) { UART.ctrl = 0; }
int uart_get(void) { return UART.state & RECEIVED ? (int)(UART.data & 255) : UART_NOTHING; }

bool uart_put(uint8_t byte)
{
    if (UART.state & FULL)
        return false;
    UART.data = byte;
    return true;
}
