/* The serial port of STM32F0, F3, G4, L4 and similar (RM0440 37). Its FIFO holds eight bytes, 0.7 ms at 115200 baud,
 * while the core stalls for the flash. */
#include "hal/port/cortex_m/uart.h"

#include "hal/stm32/chip.h"
#include "hal/stm32/uart_g4_registers.h"

enum {
    ERRORS = 15,         /* parity, framing, noise, overrun: in isr and in icr */
    ISR_RXFNE = 1 << 5,
    ISR_TXFNF = 1 << 7,
    CR1_UE = 1 << 0,
    CR1_RE = 1 << 2,
    CR1_TE = 1 << 3,
    CR1_FIFOEN = 1 << 29
};

void uart_start(uint32_t baud)
{
    UART.cr1 = 0;
    UART.brr = (machine_clocks().usart_hz + baud / 2) / baud;
    UART.cr2 = 0;
    UART.cr3 = 0;
    UART.presc = 0;
    UART.cr1 = CR1_FIFOEN | CR1_UE | CR1_TE | CR1_RE;
}

void uart_stop(void)
{
    UART.cr1 = 0;
}

int uart_get(void)
{
    uint32_t status = UART.isr;
    int byte;

    if (!(status & (ISR_RXFNE | ERRORS)))
        return UART_NOTHING;
    UART.icr = status & ERRORS;   /* clears the errors of this byte */
    byte = UART.rdr & 0xFF;
    return status & ERRORS ? UART_DAMAGED : byte;
}

bool uart_put(uint8_t byte)
{
    if (!(UART.isr & ISR_TXFNF))
        return false;
    UART.tdr = byte;
    return true;
}
