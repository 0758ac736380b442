/* pins_f405.h: what test_pins.c expects of an STM32F405 (RM0090 7, 8), on an Olimex STM32-H405. */
#ifndef OCTET_PINS_F405_H
#define OCTET_PINS_F405_H

#include "hal/stm32/stm32f405/registers.h"

enum { CAN_FUNCTION = 9, UART_FUNCTION = 7, LIT = 1 << 28, DARK = 1 << 12 };

static const uint32_t MODES_A = 0xA8000000;   /* after a reset: inputs, but for the debugger's */

volatile struct rcc_registers RCC;
volatile struct power_registers PWR;

static void begin(void)
{
}

static void assert_powered(void)
{
    TEST_ASSERT_EQUAL_HEX32(7, RCC.ahb1enr);
    TEST_ASSERT_EQUAL_HEX32(1 << 25 | 1 << 28, RCC.apb1enr);
    TEST_ASSERT_EQUAL_HEX32(7 << 5 | 1 << 4, PWR.cr);
    TEST_ASSERT_EQUAL_HEX32(1 << 4, RCC.apb2enr);
}

#endif
