/* clock_f405.h: what test_clock.c expects of an STM32F405 with a crystal of 12 MHz. */
#ifndef OCTET_CLOCK_F405_H
#define OCTET_CLOCK_F405_H

#include "hal/stm32/stm32f405/registers.h"

static const struct clocks BEST = {168000000, 42000000, 84000000, true};
static const struct clocks GOOD = {168000000, 42000000, 84000000, false};
static const struct clocks SLOW = {16000000, 16000000, 16000000, false};

enum { SW_PLL = 2, SW_INTERNAL = 0, PRESCALERS = 5 << 10 | 4 << 13, PRESCALERS_MASK = 0xFCF0, WAITS = 5, FORGET = 1 << 24 };

static bool pll_follows_crystal(void)
{
    return RCC.pllcfgr & 1u << 22;
}

static uint32_t pll_mhz(void)
{
    TEST_ASSERT_EQUAL_UINT32(0, (RCC.pllcfgr >> 6 & 511u) % 2u);   /* else half a MHz is lost below */
    return (pll_follows_crystal() ? 12u : 16u) / (RCC.pllcfgr & 63u) * (RCC.pllcfgr >> 6 & 511u) / (2u * (RCC.pllcfgr >> 16 & 3u) + 2u);
}

/* Reserved bits keep their reset value (RM0090 7.3.2). An emulator without a clock controller runs at full speed. */
static void assert_special(void)
{
    TEST_ASSERT_EQUAL_HEX32(1u << 25, CLOCK_TABLE.brown_out);   /* BORRSTF: RM0090 7.3.21 */
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(0x20000000, RCC.pllcfgr & 0xF0000000u);
    RCC.cfgr = 0;
    RCC.cr = 0;
    TEST_ASSERT_EQUAL_UINT32(168000000, clock_start().core_hz);
    TEST_ASSERT_TRUE(clock_start().exact);
    TEST_ASSERT_EQUAL_HEX32(0, RCC.cfgr);
}

#endif
