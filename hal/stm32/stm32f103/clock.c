/* 72 MHz from the board's 8 MHz crystal, or 64 MHz from the internal oscillator. */
#include "hal/stm32/chip.h"

#include "hal/stm32/stm32f103/registers.h"

#if OCTET_CRYSTAL_MHZ != 8
#error "the PLL's factor below is for 8 MHz"
#endif

enum {
    CFGR_APB1_BY_2 = 4u << 8,    /* 36 MHz, its limit */
    PLL_FROM_HSE = 1u << 16,     /* otherwise half the internal oscillator */
    PLL_BY_9 = 7u << 18,
    PLL_BY_16 = 14u << 18
};

const struct clock_table CLOCK_TABLE = {
    .cr = &RCC.cr, .cfgr = &RCC.cfgr, .pll = &RCC.cfgr, .csr = &RCC.csr, .acr = &FLASH.acr,
    .forget = 1u << 24,
    .switch_to_pll = 2,
    .from_pll = 2u << 2,
    .caches = 1u << 4,           /* prefetch */
    .waits_mask = 7,
    .waits = 2,                  /* above 48 MHz */
};

const struct clock_source CLOCK_SOURCES[] = {
    {CFGR_APB1_BY_2 | PLL_BY_16, {64000000, 32000000, 64000000, false}},
    {CFGR_APB1_BY_2 | PLL_FROM_HSE | PLL_BY_9, {72000000, 36000000, 72000000, true}},
};
const struct clocks CLOCK_SLOW = {8000000, 8000000, 8000000, false};
