/* uart_f1.h: what test_uart.c expects of an STM32F1 or F4 (RM0008 27, RM0090 30). */
#ifndef OCTET_UART_F1_EXPECTED_H
#define OCTET_UART_F1_EXPECTED_H

#include "hal/stm32/registers.h"

#define STATUS sr
#define RECEIVED dr
#define SENT dr

volatile struct usart_registers UART;

static void assert_started(void)
{
    TEST_ASSERT_EQUAL_HEX32(0x200C, UART.cr1);
    TEST_ASSERT_EQUAL_HEX32(0, UART.cr2 | UART.cr3);
}

/* Reading the byte has cleared it. */
static void assert_cleared(uint32_t error)
{
    (void)error;
}

#endif
