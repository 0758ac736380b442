/* uart_g4.h: what test_uart.c expects of an STM32G4 (RM0440 37): with FIFO, and flags that are cleared by name. */
#ifndef OCTET_UART_G4_EXPECTED_H
#define OCTET_UART_G4_EXPECTED_H

#include "hal/stm32/uart_g4_registers.h"

#define STATUS isr
#define RECEIVED rdr
#define SENT tdr

volatile struct uart_g4_registers UART;

static void assert_started(void)
{
    TEST_ASSERT_EQUAL_HEX32(0x2000000D, UART.cr1);
    TEST_ASSERT_EQUAL_HEX32(0, UART.cr2 | UART.cr3 | UART.presc);
}

static void assert_cleared(uint32_t error)
{
    TEST_ASSERT_EQUAL_HEX32(error, UART.icr);
}

#endif
