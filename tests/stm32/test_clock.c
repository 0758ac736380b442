/* What every chip's clock_start has to do. Built once for each chip, with CLOCK_EXPECTED: the header that says what is expected
 * of it, and where its manual has the registers. */
#include <stddef.h>

#include <unity.h>

#include "hal/stm32/chip.h"
#include "hal/stm32/comes_up.h"
#include CLOCK_EXPECTED
#include "clock_model.h"

enum { BOUND_MS = 125 };   /* that chip.h promises, and a look or two */

static const uint32_t SWITCH_MASK = 15;   /* SW and SWS of CFGR */

static struct clocks clocks;

void setUp(void)
{
    model_reset();
}

void tearDown(void) {}

static void assert_starts_as(const struct clocks *expected)
{
    clocks = clock_start();
    TEST_ASSERT_EQUAL_UINT32(expected->core_hz, clocks.core_hz);
    TEST_ASSERT_EQUAL_UINT32(expected->can_hz, clocks.can_hz);
    TEST_ASSERT_EQUAL_UINT32(expected->usart_hz, clocks.usart_hz);
    TEST_ASSERT_EQUAL(expected->exact, clocks.exact);
    TEST_ASSERT_EQUAL_UINT32(SLOW.core_hz, model.systick_hz);
    TEST_ASSERT_LESS_THAN_UINT32(BOUND_MS, model.now_ms);
}

static void assert_runs_from_pll(uint32_t mhz)
{
    TEST_ASSERT_EQUAL_UINT32(mhz, pll_mhz());
    TEST_ASSERT_EQUAL_HEX32(SW_PLL, RCC.cfgr & 3u);
    TEST_ASSERT_EQUAL_HEX32(PRESCALERS, RCC.cfgr & PRESCALERS_MASK);
    TEST_ASSERT_EQUAL_UINT32(WAITS, model.waits_when_switched);
    TEST_ASSERT_EQUAL_UINT32(1, model.switches);
    TEST_ASSERT_EQUAL_HEX32(RCC.cfgr & ~SWITCH_MASK, model.cfgr_before & ~SWITCH_MASK);   /* buses and PLL were set up by then */
}

static void test_the_registers_lie_where_the_manual_has_them(void)
{
    assert_registers();
}

static void test_the_crystal_makes_the_full_speed(void)
{
    assert_starts_as(&BEST);
    TEST_ASSERT_TRUE(pll_follows_crystal());
    assert_runs_from_pll(BEST.core_hz / 1000000);
}

static void test_a_slow_crystal_is_waited_for(void)
{
    model.crystal_ms = 99;
    assert_starts_as(&BEST);
}

/* A bit beside those that start something can bypass the crystal, or watch it with an interrupt. */
static void test_nothing_else_is_switched_on(void)
{
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(0, model.others_on);
}

static void test_each_wait_lasts_as_long_as_it_may_and_no_longer(void)
{
    for (unsigned late = 0; late <= 1; late++) {
        model_reset();
        model.crystal_ms = CRYSTAL_MS + late;
        TEST_ASSERT_EQUAL(late == 0, clock_start().exact);
        model_reset();
        model.pll_ms = SWITCH_MS + late;
        TEST_ASSERT_EQUAL_UINT32(late == 0 ? BEST.core_hz : SLOW.core_hz, clock_start().core_hz);
        model_reset();
        model.flash_ms = SWITCH_MS + late;
        TEST_ASSERT_EQUAL_UINT32(late == 0 ? BEST.core_hz : SLOW.core_hz, clock_start().core_hz);
        model_reset();
        model.switch_ms = SWITCH_MS + late;
        TEST_ASSERT_EQUAL_UINT32(late == 0 ? BEST.core_hz : SLOW.core_hz, clock_start().core_hz);
    }
}

static void test_without_a_crystal_the_internal_oscillator_makes_what_it_can(void)
{
    model.crystal_ms = NEVER;
    assert_starts_as(&GOOD);
    TEST_ASSERT_FALSE(pll_follows_crystal());
    assert_runs_from_pll(GOOD.core_hz / 1000000);
}

static void test_without_a_pll_it_runs_from_the_internal_oscillator(void)
{
    model.pll_ms = NEVER;
    assert_starts_as(&SLOW);
    TEST_ASSERT_EQUAL_HEX32(SW_INTERNAL, RCC.cfgr);
}

static void test_with_neither_crystal_nor_pll_it_runs_from_the_internal_oscillator(void)
{
    model.crystal_ms = model.pll_ms = NEVER;
    assert_starts_as(&SLOW);
}

static void test_a_switch_that_does_not_come_about_is_taken_back(void)
{
    model.switch_ms = NEVER;
    assert_starts_as(&SLOW);
    TEST_ASSERT_EQUAL_HEX32(SW_INTERNAL, RCC.cfgr & 3u);
}

/* RM0090 3.5.1: the flash is read too fast until its register shows the new wait states. */
static void test_the_clock_gets_no_faster_than_the_flash(void)
{
    model.flash_ms = NEVER;
    assert_starts_as(&SLOW);
    TEST_ASSERT_EQUAL_HEX32(SW_INTERNAL, RCC.cfgr & 3u);
    TEST_ASSERT_EQUAL_UINT32(0, model.switches);
}

static void test_no_data_cache_hides_what_the_store_is_now(void)
{
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(0, FLASH.acr & 1u << 10);
}

static void test_reset_flags_are_read_and_forgotten(void)
{
    RCC.csr = 0x14000000;
    TEST_ASSERT_EQUAL_HEX32(0x14000000, chip_reset_flags());
    TEST_ASSERT_EQUAL_HEX32(FORGET | 0x14000000, RCC.csr);
}

static void test_what_is_special_about_the_chip(void)
{
    assert_special();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_registers_lie_where_the_manual_has_them);
    RUN_TEST(test_the_crystal_makes_the_full_speed);
    RUN_TEST(test_a_slow_crystal_is_waited_for);
    RUN_TEST(test_nothing_else_is_switched_on);
    RUN_TEST(test_each_wait_lasts_as_long_as_it_may_and_no_longer);
    RUN_TEST(test_without_a_crystal_the_internal_oscillator_makes_what_it_can);
    RUN_TEST(test_without_a_pll_it_runs_from_the_internal_oscillator);
    RUN_TEST(test_with_neither_crystal_nor_pll_it_runs_from_the_internal_oscillator);
    RUN_TEST(test_a_switch_that_does_not_come_about_is_taken_back);
    RUN_TEST(test_the_clock_gets_no_faster_than_the_flash);
    RUN_TEST(test_no_data_cache_hides_what_the_store_is_now);
    RUN_TEST(test_reset_flags_are_read_and_forgotten);
    RUN_TEST(test_what_is_special_about_the_chip);
    return UNITY_END();
}
