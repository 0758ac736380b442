/* The clock controller's registers in RAM: it looks at them, and does as they say, whenever the driver waits for it. */
#include <stddef.h>
#include <string.h>

#include <unity.h>

#include "hal/stm32/chip.h"
#include "hal/stm32/comes_up.h"
#include "hal/stm32/stm32g431/registers.h"

enum { HSEON = 1 << 16, HSERDY = 1 << 17, PLLON = 1 << 24, PLLRDY = 1 << 25, FROM_HSI = 2, FROM_HSE = 3, FORGET = 1 << 23 };

volatile struct rcc_registers RCC;
volatile struct flash_registers FLASH;

static struct {
    bool crystal_fails, pll_fails, switch_fails;
    uint32_t waits_when_switched;   /* of the flash, when the clock got faster */
} model;

static void step(void)
{
    if (RCC.cr & HSEON && !model.crystal_fails)
        RCC.cr |= HSERDY;
    if (RCC.cr & PLLON && !model.pll_fails)
        RCC.cr |= PLLRDY;
    if ((RCC.cfgr & 3) == 3 && !(RCC.cfgr & 0xC) && !model.switch_fails) {
        RCC.cfgr |= 0xC;
        model.waits_when_switched = FLASH.acr & 15;
    }
}

bool comes_up(volatile const uint32_t *reg, uint32_t mask, uint32_t wanted)
{
    step();
    return (*reg & mask) == wanted;
}

void setUp(void)
{
    memset(&model, 0, sizeof model);
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

static void assert_clocks(uint32_t hz, bool exact)
{
    struct clocks clocks = clock_start();

    TEST_ASSERT_EQUAL_UINT32(hz, clocks.core_hz);
    TEST_ASSERT_EQUAL_UINT32(hz, clocks.can_hz);
    TEST_ASSERT_EQUAL_UINT32(hz, clocks.usart_hz);
    TEST_ASSERT_EQUAL(exact, clocks.exact);
}

static void test_a_crystal_of_24_mhz_makes_80_mhz(void)
{
    assert_clocks(80000000, true);
    TEST_ASSERT_EQUAL_HEX32(FROM_HSE, RCC.pllcfgr & 3);
    TEST_ASSERT_EQUAL_UINT32(80, pll_mhz(24));
    TEST_ASSERT_EQUAL_HEX32(0xF, RCC.cfgr);   /* no prescaler on any bus */
}

static void test_without_a_crystal_the_internal_oscillator_makes_80_mhz(void)
{
    model.crystal_fails = true;
    assert_clocks(80000000, false);
    TEST_ASSERT_EQUAL_HEX32(FROM_HSI, RCC.pllcfgr & 3);
    TEST_ASSERT_EQUAL_UINT32(80, pll_mhz(16));
}

static void test_without_a_pll_it_runs_from_the_internal_oscillator(void)
{
    model.pll_fails = true;
    assert_clocks(16000000, false);
    TEST_ASSERT_EQUAL_HEX32(1, RCC.cfgr & 3);
}

static void test_a_switch_that_does_not_come_about_is_taken_back(void)
{
    model.switch_fails = true;
    assert_clocks(16000000, false);
    TEST_ASSERT_EQUAL_HEX32(1, RCC.cfgr & 3);
}

static void test_the_flash_is_slow_enough_before_the_clock_is_fast(void)
{
    (void)clock_start();
    TEST_ASSERT_EQUAL_UINT32(2, model.waits_when_switched);
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
    RUN_TEST(test_a_crystal_of_24_mhz_makes_80_mhz);
    RUN_TEST(test_without_a_crystal_the_internal_oscillator_makes_80_mhz);
    RUN_TEST(test_without_a_pll_it_runs_from_the_internal_oscillator);
    RUN_TEST(test_a_switch_that_does_not_come_about_is_taken_back);
    RUN_TEST(test_the_flash_is_slow_enough_before_the_clock_is_fast);
    RUN_TEST(test_reset_flags_are_read_and_forgotten);
    return UNITY_END();
}
