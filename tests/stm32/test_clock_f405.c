/* Registers in RAM never change by themselves, so that each wait here ends at its bound. What becomes of a crystal and a PLL
 * that come up is tested on the emulated board. */
#include <stddef.h>
#include <string.h>

#include <unity.h>

#include "hal/stm32/chip.h"
#include "hal/stm32/stm32f405/registers.h"

enum { HSION = 1, HSERDY = 1 << 17, PLLRDY = 1 << 25, FROM_HSE = 1 << 22, FORGET = 1 << 24 };

volatile struct rcc_registers RCC;
volatile struct flash_registers FLASH;

void setUp(void)
{
    memset((void *)&RCC, 0, sizeof RCC);
    memset((void *)&FLASH, 0, sizeof FLASH);
    RCC.cr = HSION;
}

void tearDown(void) {}

static void test_the_registers_lie_where_the_manual_has_them(void)
{
    TEST_ASSERT_EQUAL_HEX(0x30, offsetof(struct rcc_registers, ahb1enr));
    TEST_ASSERT_EQUAL_HEX(0x40, offsetof(struct rcc_registers, apb1enr));
    TEST_ASSERT_EQUAL_HEX(0x44, offsetof(struct rcc_registers, apb2enr));
    TEST_ASSERT_EQUAL_HEX(0x74, offsetof(struct rcc_registers, csr));
}

static void test_without_crystal_and_pll_it_runs_from_the_internal_oscillator(void)
{
    struct clocks clocks = clock_start();

    TEST_ASSERT_EQUAL_UINT32(16000000, clocks.core_hz);
    TEST_ASSERT_EQUAL_UINT32(16000000, clocks.can_hz);
    TEST_ASSERT_EQUAL_UINT32(16000000, clocks.usart_hz);
    TEST_ASSERT_FALSE(clocks.exact);
    TEST_ASSERT_EQUAL_HEX32(0, RCC.cfgr);
}

static void test_a_crystal_of_12_mhz_makes_168_mhz(void)
{
    RCC.cr |= HSERDY;
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(FROM_HSE, RCC.pllcfgr & FROM_HSE);
    TEST_ASSERT_EQUAL_UINT32(168, 12 / (RCC.pllcfgr & 63) * (RCC.pllcfgr >> 6 & 511) / (2 * (RCC.pllcfgr >> 16 & 3) + 2));
}

static void test_without_a_crystal_the_internal_oscillator_makes_168_mhz(void)
{
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(0, RCC.pllcfgr & FROM_HSE);
    TEST_ASSERT_EQUAL_UINT32(168, 16 / (RCC.pllcfgr & 63) * (RCC.pllcfgr >> 6 & 511) / (2 * (RCC.pllcfgr >> 16 & 3) + 2));
}

static void test_a_switch_that_does_not_come_about_is_taken_back(void)
{
    RCC.cr |= HSERDY | PLLRDY;
    TEST_ASSERT_EQUAL_UINT32(16000000, clock_start().core_hz);
    TEST_ASSERT_EQUAL_HEX32(0, RCC.cfgr);
    TEST_ASSERT_EQUAL_HEX32(5, FLASH.acr & 15);   /* set before the switch, and no harm after it */
}

static void test_an_emulator_without_a_clock_controller_runs_at_full_speed(void)
{
    RCC.cr = 0;
    TEST_ASSERT_EQUAL_UINT32(168000000, clock_start().core_hz);
    TEST_ASSERT_EQUAL_HEX32(0, RCC.cfgr);
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
    RUN_TEST(test_a_crystal_of_12_mhz_makes_168_mhz);
    RUN_TEST(test_without_a_crystal_the_internal_oscillator_makes_168_mhz);
    RUN_TEST(test_a_switch_that_does_not_come_about_is_taken_back);
    RUN_TEST(test_an_emulator_without_a_clock_controller_runs_at_full_speed);
    RUN_TEST(test_reset_flags_are_read_and_forgotten);
    return UNITY_END();
}
