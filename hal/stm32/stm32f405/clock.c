/* 168 MHz from the board's crystal, or from the internal 16 MHz. */
#include "hal/stm32/chip.h"

#include "hal/stm32/stm32f405/registers.h"

enum {
    CFGR_APB1_BY_4 = 5u << 10,   /* 42 MHz, its limit */
    CFGR_APB2_BY_2 = 4u << 13,   /* 84 MHz, its limit */
    PLL_N = 336u << 6,           /* 1 MHz in, 336 MHz inside, */
    PLL_P_2 = 0u << 16,          /* halved: 168 MHz out */
    PLL_FROM_HSE = 1u << 22,
    PLL_Q_7 = 7u << 24,          /* 48 MHz, not used */
    PLL_RESERVED = 2u << 28,     /* as after reset */
    PLL = PLL_N | PLL_P_2 | PLL_Q_7 | PLL_RESERVED,
    HSI_MHZ = 16
};

const struct clock_table CLOCK_TABLE = {
    .cr = &RCC.cr, .cfgr = &RCC.cfgr, .pll = &RCC.pllcfgr, .csr = &RCC.csr, .acr = &FLASH.acr,
    .on_after_reset = 1u << 0,   /* HSION */
    .forget = 1u << 24,
    .brown_out = 1u << 25,
    .buses = CFGR_APB1_BY_4 | CFGR_APB2_BY_2,
    .switch_to_pll = 2,
    .from_pll = 2u << 2,
    .caches = 3u << 8,           /* prefetch and instruction cache; a data cache would hold stale data of the store */
    .waits_mask = 7,
    .waits = 5,                  /* at 168 MHz and 3.3 V, 3.5.1 */
};

const struct clock_source CLOCK_SOURCES[] = {
    {PLL | HSI_MHZ, {168000000, 42000000, 84000000, false}},
    {PLL | PLL_FROM_HSE | OCTET_CRYSTAL_MHZ, {168000000, 42000000, 84000000, true}},
};
const struct clocks CLOCK_SLOW = {16000000, 16000000, 16000000, false};
