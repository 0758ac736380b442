/* What every chip's clock_start has to do. Built once for each chip, with CLOCK_EXPECTED: the header that says what is expected
 * of it, and where its manual has the registers. */

#include "tests/test.h"
#include "hal/stm32/chip.h"
#include CLOCK_EXPECTED
#include "clock_model.h"

enum { BOUND_MS = 125 };   /* that chip.h promises, and a look or two */

static const uint32_t SWITCH_MASK = 15;   /* SW and SWS of CFGR */

static struct clocks clocks;

void setUp(void)
{
    model_reset();
}

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

TEST(clock_start_reaches_full_speed_from_the_crystal)
{
    assert_starts_as(&BEST);
    TEST_ASSERT_TRUE(pll_follows_crystal());
    assert_runs_from_pll(BEST.core_hz / 1000000);
}

TEST(slow_crystal_is_waited_for)
{
    model.crystal_ms = 99;
    assert_starts_as(&BEST);
}

/* A bit beside those that start something can bypass the crystal, or watch it with an interrupt. */
TEST(clock_start_enables_nothing_else)
{
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(0, model.others_on);
}

TEST(waits_end_exactly_at_their_limits)
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

TEST(missing_crystal_falls_back_to_internal_oscillator_and_pll)
{
    model.crystal_ms = NEVER;
    assert_starts_as(&GOOD);
    TEST_ASSERT_FALSE(pll_follows_crystal());
    assert_runs_from_pll(GOOD.core_hz / 1000000);
}

TEST(missing_pll_falls_back_to_internal_oscillator)
{
    model.pll_ms = NEVER;
    assert_starts_as(&SLOW);
    TEST_ASSERT_EQUAL_HEX32(SW_INTERNAL, RCC.cfgr);
}

TEST(missing_crystal_and_pll_fall_back_to_internal_oscillator)
{
    model.crystal_ms = model.pll_ms = NEVER;
    assert_starts_as(&SLOW);
}

TEST(failed_clock_switch_is_reverted)
{
    model.switch_ms = NEVER;
    assert_starts_as(&SLOW);
    TEST_ASSERT_EQUAL_HEX32(SW_INTERNAL, RCC.cfgr & 3u);
}

/* RM0090 3.5.1: the flash is read too fast until its register shows the new wait states. */
TEST(clock_stays_slow_without_flash_wait_states)
{
    model.flash_ms = NEVER;
    assert_starts_as(&SLOW);
    TEST_ASSERT_EQUAL_HEX32(SW_INTERNAL, RCC.cfgr & 3u);
    TEST_ASSERT_EQUAL_UINT32(0, model.switches);
}

TEST(clock_start_disables_the_flash_data_cache)
{
    for (unsigned pll = 0; pll <= 1; pll++) {
        model_reset();
        model.pll_ms = pll ? 0 : NEVER;
        FLASH.acr = 0x40600 | WAITS;   /* as after a reset of an STM32G4, and the boot loader in its ROM */
        (void)clock_start();
        TEST_ASSERT_EQUAL_HEX32(0, FLASH.acr & 1u << 10);
        TEST_ASSERT_EQUAL_HEX32(CLOCK_TABLE.caches | WAITS, FLASH.acr);
    }
}

TEST(reset_flags_are_read_and_cleared)
{
    RCC.csr = 0x14000000;
    TEST_ASSERT_EQUAL_HEX32(0x14000000, chip_reset_flags());
    TEST_ASSERT_EQUAL_HEX32(FORGET | 0x14000000, RCC.csr);
}

TEST(brown_out_counts_as_power_on)
{
    RCC.csr = CLOCK_TABLE.brown_out | 1u << 26;   /* as each reset, it pulls the pin */
    TEST_ASSERT_EQUAL(CLOCK_TABLE.brown_out != 0, (chip_reset_flags() & CHIP_POWER_ON) != 0);
}

TEST(clock_start_sets_the_registers_special_to_the_chip)
{
    assert_special();
}
