/* clock_f103.h: what test_clock.c expects of an STM32F103 with a crystal of 8 MHz. */
#ifndef OCTET_CLOCK_F103_H
#define OCTET_CLOCK_F103_H

#include "hal/stm32/stm32f103/registers.h"

static const struct clocks BEST = {72000000, 36000000, 72000000, true};
static const struct clocks GOOD = {64000000, 32000000, 64000000, false};
static const struct clocks SLOW = {8000000, 8000000, 8000000, false};

enum { SW_PLL = 2, SW_INTERNAL = 0, PRESCALERS = 4 << 8, PRESCALERS_MASK = 0x3FF0, WAITS = 2, FORGET = 1 << 24 };

static bool pll_follows_crystal(void)
{
    return RCC.cfgr & 1u << 16;
}

static uint32_t pll_mhz(void)
{
    return (pll_follows_crystal() ? 8u : 4u) * ((RCC.cfgr >> 18 & 15u) + 2u);
}

static void assert_special(void)
{
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(1u << 4, FLASH.acr & 1u << 4);   /* prefetch */
}

#endif
