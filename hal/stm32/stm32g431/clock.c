/* 80 MHz from the board's crystal, or from the internal 16 MHz.
 *
 * 170 MHz would require a voltage boost and a pause at half speed; a tick takes only 3,000 instructions, and 80 MHz
 * gives 16 quanta per CAN bit. */
#include "hal/stm32/chip.h"

#include "hal/stm32/stm32g431/registers.h"

#if OCTET_CRYSTAL_MHZ % 4 != 0
#error "the PLL's input is 4 MHz"
#endif

enum {
    CFGR_SW_HSI = 1,
    PLL_FROM_HSI = 2,
    PLL_FROM_HSE = 3,
    PLL_IN_MHZ = 4,
    PLL_M_AT = 4,
    PLL_N_40 = 40u << 8,         /* 160 MHz inside, */
    PLL_R_2 = 0u << 25,          /* halved: 80 MHz out */
    PLL_R_ON = 1u << 24,
    PLL = PLL_R_2 | PLL_R_ON | PLL_N_40,
    HSI_MHZ = 16,
    ACR_CACHES = 3u << 8,        /* prefetch and instruction cache; a data cache would hold stale data of the store */
    ACR_DEBUGGER = 1u << 18
};

const struct clock_table CLOCK_TABLE = {
    .cr = &RCC.cr, .cfgr = &RCC.cfgr, .pll = &RCC.pllcfgr, .csr = &RCC.csr, .acr = &FLASH.acr,
    .forget = 1u << 23,
    .internal = CFGR_SW_HSI,
    .buses = CFGR_SW_HSI,        /* as after reset */
    .switch_to_pll = 3,
    .from_pll = 3u << 2,
    .caches = ACR_CACHES | ACR_DEBUGGER,
    .waits_mask = 15,
    .waits = 2,                  /* up to 90 MHz without boost, 5.3.3 */
};

const struct clock_source CLOCK_SOURCES[] = {
    {PLL | (HSI_MHZ / PLL_IN_MHZ - 1) << PLL_M_AT | PLL_FROM_HSI, {80000000, 80000000, 80000000, false}},
    {PLL | (OCTET_CRYSTAL_MHZ / PLL_IN_MHZ - 1) << PLL_M_AT | PLL_FROM_HSE, {80000000, 80000000, 80000000, true}},
};
const struct clocks CLOCK_SLOW = {16000000, 16000000, 16000000, false};
