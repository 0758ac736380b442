/* clock_g431.h: what test_clock.c expects of an STM32G431 with a crystal of 24 MHz. */
#ifndef OCTET_CLOCK_G431_H
#define OCTET_CLOCK_G431_H

#include "hal/stm32/stm32g431/registers.h"

static const struct clocks BEST = {80000000, 80000000, 80000000, true};
static const struct clocks GOOD = {80000000, 80000000, 80000000, false};
static const struct clocks SLOW = {16000000, 16000000, 16000000, false};

enum { SW_PLL = 3, SW_INTERNAL = 1, PRESCALERS = 0, PRESCALERS_MASK = 0x3FF0, WAITS = 2, FORGET = 1 << 23 };

static bool pll_follows_crystal(void)
{
    return (RCC.pllcfgr & 3u) == 3u;
}

static uint32_t pll_mhz(void)
{
    uint32_t source = pll_follows_crystal() ? 24u : 16u;

    return source / ((RCC.pllcfgr >> 4 & 15u) + 1u) * (RCC.pllcfgr >> 8 & 127u) / (2u * (RCC.pllcfgr >> 25 & 3u) + 2u);
}

static void assert_special(void)
{
    (void)clock_start();
    TEST_ASSERT_EQUAL_HEX32(1u << 24, RCC.pllcfgr & 1u << 24);   /* the PLL's output is on */
    TEST_ASSERT_EQUAL_HEX32(1u << 18 | 3u << 8, FLASH.acr & ~(uint32_t)WAITS);   /* prefetch, instruction cache, and debugging */
}

#endif
