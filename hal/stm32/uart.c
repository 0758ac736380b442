#include "hal/stm32/uart.h"

#include "hal/stm32/registers.h"

enum {
    SR_ERRORS = 15,   /* parity, framing, noise, overrun */
    SR_RXNE = 1 << 5,
    SR_TXE = 1 << 7,
    CR1_RE = 1 << 2,
    CR1_TE = 1 << 3,
    CR1_UE = 1 << 13
};

void uart_start(uint32_t clock_hz, uint32_t baud)
{
    USART1.brr = (clock_hz + baud / 2) / baud;
    USART1.cr2 = 0;
    USART1.cr3 = 0;
    USART1.cr1 = CR1_UE | CR1_TE | CR1_RE;
}

void uart_stop(void)
{
    USART1.cr1 = 0;
}

int uart_get(void)
{
    uint32_t status = USART1.sr;
    int byte;

    if (!(status & (SR_RXNE | SR_ERRORS)))
        return UART_NOTHING;
    byte = USART1.dr & 0xFF;   /* clears the errors as well */
    return status & SR_ERRORS ? UART_DAMAGED : byte;
}

bool uart_put(uint8_t byte)
{
    if (!(USART1.sr & SR_TXE))
        return false;
    USART1.dr = byte;
    return true;
}
