/* pins_g431.h: what test_pins.c expects of an STM32G431 (RM0440 7, 9), on a NUCLEO-G431RB. */
#ifndef OCTET_PINS_G431_H
#define OCTET_PINS_G431_H

#include "hal/stm32/stm32g431/registers.h"

enum { CAN_FUNCTION = 9, UART_FUNCTION = 7, LIT = 1 << 5, DARK = 1 << 21 };

static const uint32_t MODES_A = 0xABFFFFFF;   /* after a reset: analog, but for the debugger's */

volatile struct rcc_registers RCC;
volatile struct power_registers PWR;

static void begin(void)
{
    PWR.cr3 = 1 << 15;
}

/* And CAN runs from the bus clock. */
static void assert_powered(void)
{
    TEST_ASSERT_EQUAL_HEX32(7, RCC.ahb2enr);
    TEST_ASSERT_EQUAL_HEX32(1 << 25 | 1 << 17 | 1 << 28, RCC.apb1enr1);
    TEST_ASSERT_EQUAL_HEX32(6 << 1 | 1 << 0, PWR.cr2);
    TEST_ASSERT_EQUAL_HEX32(1 << 14 | 1 << 15, PWR.cr3);   /* 6.4.3: what a reset leaves, and no pull-downs of a dead battery */
    TEST_ASSERT_EQUAL_HEX32(2u << 24, RCC.ccipr);   /* and nothing else does not */
}

#endif
