/* 168 MHz from the board's crystal, or from the internal 16 MHz. */
#include "hal/port/cortex_m/systick.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/comes_up.h"
#include "hal/stm32/stm32f405/registers.h"

enum {
    CSR_FORGET = 1 << 24,
    HSION = 1u << 0,
    HSEON = 1u << 16,
    HSERDY = 1u << 17,
    PLLON = 1u << 24,
    PLLRDY = 1u << 25,
    CFGR_SW_PLL = 2,
    CFGR_SWS = 3u << 2,
    CFGR_SWS_PLL = 2u << 2,
    CFGR_APB1_BY_4 = 5u << 10,   /* 42 MHz, its limit */
    CFGR_APB2_BY_2 = 4u << 13,   /* 84 MHz, its limit */
    PLL_N = 336,                 /* 1 MHz in, 336 MHz inside, */
    PLL_P_2 = 0u << 16,          /* halved: 168 MHz out */
    PLL_Q_7 = 7u << 24,          /* 48 MHz, not used */
    PLL_FROM_HSE = 1u << 22,
    PLL_RESERVED = 2u << 28,     /* as after reset */
    HSI_MHZ = 16,
    ACR_WAITS = 7,
    ACR_5_WAITS = 5,             /* at 168 MHz and 3.3 V, 3.5.1 */
    ACR_CACHES = 3u << 8         /* prefetch and instruction cache; a data cache would remember what the store was */
};

static bool start_crystal(void)
{
    RCC.cr |= HSEON;
    return comes_up(&RCC.cr, HSERDY, HSERDY, CRYSTAL_MS);
}

static bool start_pll(uint32_t source, uint32_t source_mhz)
{
    RCC.pllcfgr = PLL_RESERVED | PLL_Q_7 | source | PLL_P_2 | (uint32_t)PLL_N << 6 | source_mhz;
    RCC.cr |= PLLON;
    return comes_up(&RCC.cr, PLLRDY, PLLRDY, SWITCH_MS);
}

/* The buses and the flash, which says when it is (3.5.1), are slowed down before the clock gets faster. */
static bool switch_to_pll(void)
{
    RCC.cfgr = CFGR_APB1_BY_4 | CFGR_APB2_BY_2;
    FLASH.acr = ACR_CACHES | ACR_5_WAITS;
    if (!comes_up(&FLASH.acr, ACR_WAITS, ACR_5_WAITS, SWITCH_MS))
        return false;
    RCC.cfgr = CFGR_APB1_BY_4 | CFGR_APB2_BY_2 | CFGR_SW_PLL;
    return comes_up(&RCC.cfgr, CFGR_SWS, CFGR_SWS_PLL, SWITCH_MS);
}

struct clocks clock_start(void)
{
    struct clocks fast = {168000000, 42000000, 84000000, true};
    struct clocks slow = {16000000, 16000000, 16000000, false};

    /* This bit is never 0 on a chip that runs from its internal oscillator, as after reset. An emulator without a
     * clock controller, as QEMU's, runs at full speed at once. */
    if (!(RCC.cr & HSION))
        return fast;
    systick_start(slow.core_hz);
    fast.exact = start_crystal();
    if (start_pll(fast.exact ? PLL_FROM_HSE : 0, fast.exact ? OCTET_CRYSTAL_MHZ : HSI_MHZ) && switch_to_pll())
        return fast;
    RCC.cfgr = 0;
    return slow;
}

uint32_t chip_reset_flags(void)
{
    uint32_t flags = RCC.csr;

    RCC.csr = flags | CSR_FORGET;
    return flags;
}
