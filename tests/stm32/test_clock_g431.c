/* Registers in RAM never change by themselves, so that each wait here ends at its bound, unless the test has set what it waits
 * for. */
#include <stddef.h>
#include <string.h>

#include <unity.h>

#include "hal/stm32/chip.h"
#include "hal/stm32/stm32g431/registers.h"

enum { HSERDY = 1 << 17, PLLRDY = 1 << 25, FROM_HSI = 2, FROM_HSE = 3, FORGET = 1 << 23 };

volatile struct rcc_registers RCC;
volatile struct flash_registers FLASH;

void setUp(void)
{
    memset((void *)&RCC, 0, sizeof RCC);
    memset((void *)&FLASH, 0, sizeof FLASH);
    RCC.cr = 0x500;
    RCC.cfgr = 5;
}

void tearDown(void) {}

static void test_the_registers_lie_where_the_manual_has_them(void)
{
    TEST_ASSERT_EQUAL_HEX(0x0C, offsetof(struct rcc_registers, pllcfgr));
    TEST_ASSERT_EQUAL_HEX(0x4C, offsetof(struct rcc_registers, ahb2enr));
    TEST_ASSERT_EQUAL_HEX(0x58, offsetof(struct rcc_registers, apb1enr1));
    TEST_ASSERT_EQUAL_HEX(0x88, offsetof(struct rcc_registers, ccipr));
    TEST_ASSERT_EQUAL_HEX(0x94, offsetof(struct rcc_registers, csr));
    TEST_ASSERT_EQUAL_HEX(0x08, offsetof(struct flash_registers, keyr));
    TEST_ASSERT_EQUAL_HEX(0x18, offsetof(struct flash_registers, eccr));
}

/* MHz that the PLL makes, as it is set. */
static uint32_t pll_mhz(uint32_t source_mhz)
{
    uint32_t m = (RCC.pllcfgr >> 4 & 15) + 1, n = RCC.pllcfgr >> 8 & 127, r = 2 * (RCC.pllcfgr >> 25 & 3) + 2;

    TEST_ASSERT_EQUAL_UINT32(0, source_mhz % m);
    TEST_ASSERT_EQUAL_HEX32(1 << 24, RCC.pllcfgr & 1 << 24);   /* its output is on */
    return source_mhz / m * n / r;
}

static void test_without_crystal_and_pll_it_runs_from_the_internal_oscillator(void)
{
    struct clocks clocks = clock_start();

    TEST_ASSERT_EQUAL_UINT32(16000000, clocks.core_hz);
    TEST_ASSERT_EQUAL_UINT32(16000000, clocks.can_hz);
    TEST_ASSERT_EQUAL_UINT32(16000000, clocks.usart_hz);
    TEST_ASSERT_FALSE(clocks.exact);
    TEST_ASSERT_EQUAL_HEX32(1, RCC.cfgr & 3);
}

static void test_a_crystal_of_24_mhz_makes_80_mhz(void)
{
    RCC.cr |= HSERDY;
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(FROM_HSE, RCC.pllcfgr & 3);
    TEST_ASSERT_EQUAL_UINT32(80, pll_mhz(24));
}

static void test_without_a_crystal_the_internal_oscillator_makes_80_mhz(void)
{
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(FROM_HSI, RCC.pllcfgr & 3);
    TEST_ASSERT_EQUAL_UINT32(80, pll_mhz(16));
}

static void test_a_switch_that_does_not_come_about_is_taken_back(void)
{
    RCC.cr |= HSERDY | PLLRDY;
    TEST_ASSERT_EQUAL_UINT32(16000000, clock_start().core_hz);
    TEST_ASSERT_EQUAL_HEX32(1, RCC.cfgr & 3);
    TEST_ASSERT_EQUAL_HEX32(2, FLASH.acr & 15);        /* set before the switch, and no harm after it */
    TEST_ASSERT_EQUAL_HEX32(0, FLASH.acr & 1 << 10);   /* no data cache */
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
    RUN_TEST(test_a_crystal_of_24_mhz_makes_80_mhz);
    RUN_TEST(test_without_a_crystal_the_internal_oscillator_makes_80_mhz);
    RUN_TEST(test_a_switch_that_does_not_come_about_is_taken_back);
    RUN_TEST(test_reset_flags_are_read_and_forgotten);
    return UNITY_END();
}
