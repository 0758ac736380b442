/* robot_pins_f103.h: what test_robot_pins.c expects of an STM32F103 (RM0008), on a Blue Pill. */
#ifndef OCTET_ROBOT_PINS_F103_H
#define OCTET_ROBOT_PINS_F103_H

#include "hal/stm32/stm32f103/registers.h"

enum { CORE_HZ = 72000000 };
enum { ANALOGUE = 0, PULLED = 8, OUTPUT = 2, ALTERNATE = 11, FLOATING = 4 };

extern volatile struct gpio_port GPIO[PORTS];

static void pins_after_reset(void)
{
    for (unsigned port = 0; port < PORTS; port++)
        GPIO[port].at.cr[0] = GPIO[port].at.cr[1] = 0x44444444;
}

static uint32_t mode(unsigned port, unsigned pin)
{
    return GPIO[port].at.cr[pin / 8] >> 4 * (pin % 8) & 15u;
}

static void assert_pins(void)
{
    for (unsigned pin = 0; pin <= 5; pin++)
        TEST_ASSERT_EQUAL_HEX32(ANALOGUE, mode(A, pin));
    TEST_ASSERT_EQUAL_HEX32(PULLED, mode(A, 6));
    TEST_ASSERT_EQUAL_HEX32(ALTERNATE, mode(A, 8));
    TEST_ASSERT_EQUAL_HEX32(ALTERNATE, mode(A, 11));
    TEST_ASSERT_EQUAL_HEX32(PULLED, mode(B, 0));
    TEST_ASSERT_EQUAL_HEX32(PULLED, mode(A, 15));
    TEST_ASSERT_EQUAL_HEX32(PULLED, mode(B, 12));
    TEST_ASSERT_EQUAL_HEX32(OUTPUT, mode(B, 5));
    TEST_ASSERT_EQUAL_HEX32(OUTPUT, mode(B, 13));
    TEST_ASSERT_EQUAL_HEX32(ALTERNATE, mode(B, 14));
    TEST_ASSERT_EQUAL_HEX32(ALTERNATE, mode(B, 15));
    TEST_ASSERT_EQUAL_HEX32(FLOATING, mode(A, 13));
    TEST_ASSERT_EQUAL_HEX32(FLOATING, mode(C, 0));
}

#define CHIP_REGISTERS                                                                                        \
    {"RCC ahbenr", 1, RCC.ahbenr}, {"RCC apb2enr", 1 << 9 | 1 << 11, RCC.apb2enr}, {"RCC apb1enr", 7, RCC.apb1enr}, \
    {"RCC cfgr", 2 << 14, RCC.cfgr}, {"ADC1 sqr1", 5 << 20, ADC1.sqr[0]},                                     \
    {"ADC1 sqr3", 0 | 1 << 5 | 2 << 10 | 3 << 15 | 4 << 20 | 5 << 25, ADC1.sqr[2]},                           \
    {"ADC1 smpr2", 0x3FFFFFFF, ADC1.smpr[1]}, {"ADC1 cr1", 1 << 8, ADC1.cr1},                                 \
    {"TIM1 bdtr", 1 << 15 | 1 << 12 | 1 << 10, TIM1.bdtr},                                                    \
    {"ADC1 cr2", 1 << 22 | 1 << 20 | 7 << 17 | 1 << 8 | 3, ADC1.cr2},

#endif
