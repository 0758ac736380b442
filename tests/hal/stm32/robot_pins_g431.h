/* robot_pins_g431.h: what test_robot_pins.c expects of an STM32G431 (RM0440), on a NUCLEO-G431RB. */
#ifndef OCTET_ROBOT_PINS_G431_H
#define OCTET_ROBOT_PINS_G431_H

#include "hal/stm32/gpio/gpio_f4.h"
#include "hal/stm32/stm32g431/registers.h"

enum { CORE_HZ = 80000000 };
enum { OUTPUT = 1, ALTERNATE = 2, ANALOGUE = 3 };

volatile struct dmamux_registers DMAMUX;

static void pins_after_reset(void)
{
    for (unsigned port = 0; port < PORTS; port++)
        GPIO[port].at.moder = 0xFFFFFFFF;
    GPIO[C].at.moder = GPIO[A].at.moder = 0;   /* as if a program before had used them */
    ADC1.cr = 1u << 29;
}

static void assert_pin(unsigned port, unsigned pin, uint32_t mode, uint32_t pull, uint32_t function)
{
    const volatile struct gpio_registers *gpio = &GPIO[port].at;

    TEST_ASSERT_EQUAL_HEX32(mode, gpio->moder >> 2 * pin & 3u);
    TEST_ASSERT_EQUAL_HEX32(pull, gpio->pupdr >> 2 * pin & 3u);
    TEST_ASSERT_EQUAL_HEX32(function, gpio->afr[pin / 8] >> 4 * (pin % 8) & 15u);
}

static void assert_pins(void)
{
    for (unsigned pin = 0; pin < 3; pin++)
        assert_pin(C, pin, ANALOGUE, 0, 0);
    assert_pin(B, 1, ANALOGUE, 0, 0);
    assert_pin(C, 3, ALTERNATE, 0, 2);
    assert_pin(A, 0, ANALOGUE, 0, 0);
    assert_pin(A, 1, ANALOGUE, 0, 0);
    assert_pin(A, 6, ALTERNATE, 1, 2);
    assert_pin(A, 7, ALTERNATE, 1, 2);
    assert_pin(A, 8, ALTERNATE, 0, 6);
    assert_pin(A, 15, ALTERNATE, 1, 1);
    assert_pin(B, 0, 0, 1, 0);
    assert_pin(B, 13, OUTPUT, 0, 0);
    assert_pin(B, 6, ALTERNATE, 1, 2);
    assert_pin(B, 7, ALTERNATE, 1, 2);
    assert_pin(B, 10, 0, 1, 0);
    assert_pin(B, 12, ALTERNATE, 1, 6);
    assert_pin(B, 14, ALTERNATE, 0, 6);
    assert_pin(B, 15, ALTERNATE, 0, 4);
    assert_pin(A, 5, 0, 0, 0);
    TEST_ASSERT_EQUAL_HEX32(1u << 29, GPIO[B].at.bsrr);   /* the last of its outputs is low, and no pin of A or C was written */
    TEST_ASSERT_EQUAL_HEX32(0, GPIO[A].at.bsrr | GPIO[C].at.bsrr);
}

#define CHIP_REGISTERS                                                                                             \
    {"RCC ahb1enr", 5, RCC.ahb1enr}, {"RCC ahb2enr", 1 << 13, RCC.ahb2enr}, {"RCC apb2enr", 1 << 11, RCC.apb2enr}, \
    {"RCC apb1enr1", 7, RCC.apb1enr1}, {"DMAMUX c0cr", 5, DMAMUX.ccr[0]}, {"ADC12 ccr", 3 << 16, ADC1.common.ccr}, \
    {"ADC1 sqr1", 5 | 6 << 6 | 7 << 12 | 8 << 18 | 12 << 24, ADC1.sqr[0]}, {"ADC1 sqr2", 1 | 2 << 6, ADC1.sqr[1]},  \
    {"ADC1 smpr1", 0x3FFFFFFF, ADC1.smpr[0]}, {"ADC1 smpr2", 0x07FFFFFF, ADC1.smpr[1]},                             \
    {"ADC1 cfgr", 0x3003, ADC1.cfgr}, {"TIM1 bdtr", 15 << 16 | 1 << 15 | 1 << 12 | 1 << 10, TIM1.bdtr},              \
    {"ADC1 cr", 1 << 28 | 1 << 2 | 1, ADC1.cr},

#endif
