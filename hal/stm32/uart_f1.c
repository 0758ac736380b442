/* The serial port of an STM32F1, F2 or F4 (RM0008 27, RM0090 30): one status register, one data register. */
#include "hal/port/cortex_m/uart.h"

#include "hal/stm32/chip.h"
#include "hal/stm32/registers.h"

enum {
    SR_ERRORS = 15,   /* parity, framing, noise, overrun */
    SR_RXNE = 1 << 5,
    SR_TXE = 1 << 7,
    CR1_RE = 1 << 2,
    CR1_TE = 1 << 3,
    CR1_UE = 1 << 13
};

void uart_start(uint32_t baud)
{
    UART.brr = (machine_clocks().usart_hz + baud / 2) / baud;
    UART.cr2 = 0;
    UART.cr3 = 0;
    UART.cr1 = CR1_UE | CR1_TE | CR1_RE;
}

void uart_stop(void)
{
    UART.cr1 = 0;
}

int uart_get(void)
{
    uint32_t status = UART.sr;
    int byte;

    if (!(status & (SR_RXNE | SR_ERRORS)))
        return UART_NOTHING;
    byte = UART.dr & 0xFF;   /* clears the errors as well */
    return status & SR_ERRORS ? UART_DAMAGED : byte;
}

bool uart_put(uint8_t byte)
{
    if (!(UART.sr & SR_TXE))
        return false;
    UART.dr = byte;
    return true;
}
