/* As test_clock_f405.c. */
#include <stddef.h>
#include <string.h>

#include <unity.h>

#include "hal/stm32/chip.h"
#include "hal/stm32/stm32f103/registers.h"

enum { HSERDY = 1 << 17, PLLRDY = 1 << 25, FORGET = 1 << 24 };

volatile struct rcc_registers RCC;
volatile struct flash_registers FLASH;

void setUp(void)
{
    memset((void *)&RCC, 0, sizeof RCC);
    memset((void *)&FLASH, 0, sizeof FLASH);
}

void tearDown(void) {}

static void test_the_registers_lie_where_the_manual_has_them(void)
{
    TEST_ASSERT_EQUAL_HEX(0x18, offsetof(struct rcc_registers, apb2enr));
    TEST_ASSERT_EQUAL_HEX(0x1C, offsetof(struct rcc_registers, apb1enr));
    TEST_ASSERT_EQUAL_HEX(0x24, offsetof(struct rcc_registers, csr));
    TEST_ASSERT_EQUAL_HEX(0x14, offsetof(struct flash_registers, ar));
    TEST_ASSERT_EQUAL_HEX(0x400, sizeof(struct gpio_port));
}

static void test_without_crystal_and_pll_it_runs_from_the_internal_oscillator(void)
{
    struct clocks clocks = clock_start();

    TEST_ASSERT_EQUAL_UINT32(8000000, clocks.core_hz);
    TEST_ASSERT_EQUAL_UINT32(8000000, clocks.can_hz);
    TEST_ASSERT_EQUAL_UINT32(8000000, clocks.usart_hz);
    TEST_ASSERT_FALSE(clocks.exact);
    TEST_ASSERT_EQUAL_HEX32(0, RCC.cfgr);
}

static void test_a_switch_that_does_not_come_about_is_taken_back(void)
{
    RCC.cr = HSERDY | PLLRDY;
    TEST_ASSERT_EQUAL_UINT32(8000000, clock_start().core_hz);
    TEST_ASSERT_EQUAL_HEX32(0, RCC.cfgr);
    TEST_ASSERT_EQUAL_HEX32(2, FLASH.acr & 7);   /* set before the switch, and no harm after it */
}

static void test_reset_flags_are_read_and_forgotten(void)
{
    RCC.csr = 0x14000000;
    TEST_ASSERT_EQUAL_HEX32(0x14000000, chip_reset_flags());
    TEST_ASSERT_EQUAL_HEX32(FORGET, RCC.csr & FORGET);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_registers_lie_where_the_manual_has_them);
    RUN_TEST(test_without_crystal_and_pll_it_runs_from_the_internal_oscillator);
    RUN_TEST(test_a_switch_that_does_not_come_about_is_taken_back);
    RUN_TEST(test_reset_flags_are_read_and_forgotten);
    return UNITY_END();
}
