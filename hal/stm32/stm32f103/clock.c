/* 72 MHz from the board's 8 MHz crystal, or 64 MHz from the internal oscillator. */
#include "hal/port/cortex_m/systick.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/comes_up.h"
#include "hal/stm32/stm32f103/registers.h"

#if OCTET_CRYSTAL_MHZ != 8
#error "the PLL's factor below is for 8 MHz"
#endif

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
    CFGR_APB1_BY_2 = 4u << 8,    /* 36 MHz, its limit */
    PLL_FROM_HSE = 1u << 16,     /* else from half the internal oscillator */
    PLL_BY_9 = 7u << 18,
    PLL_BY_16 = 14u << 18,
    ACR_WAITS = 7,
    ACR_2_WAITS = 2,             /* above 48 MHz */
    ACR_PREFETCH = 1u << 4
};

static bool start_crystal(void)
{
    RCC.cr |= HSEON;
    return comes_up(&RCC.cr, HSERDY, HSERDY, CRYSTAL_MS);
}

static bool start_pll(uint32_t setting)
{
    RCC.cfgr = CFGR_APB1_BY_2 | setting;
    RCC.cr |= PLLON;
    return comes_up(&RCC.cr, PLLRDY, PLLRDY, SWITCH_MS);
}

/* The flash is slowed down before the clock gets faster. */
static bool switch_to_pll(uint32_t setting)
{
    FLASH.acr = ACR_PREFETCH | ACR_2_WAITS;
    if (!comes_up(&FLASH.acr, ACR_WAITS, ACR_2_WAITS, SWITCH_MS))
        return false;
    RCC.cfgr = CFGR_APB1_BY_2 | setting | CFGR_SW_PLL;
    return comes_up(&RCC.cfgr, CFGR_SWS, CFGR_SWS_PLL, SWITCH_MS);
}

struct clocks clock_start(void)
{
    static const struct clocks best = {72000000, 36000000, 72000000, true};
    static const struct clocks good = {64000000, 32000000, 64000000, false};
    static const struct clocks slow = {8000000, 8000000, 8000000, false};
    bool exact;
    uint32_t setting;

    systick_start(slow.core_hz);
    exact = start_crystal();
    setting = exact ? PLL_FROM_HSE | PLL_BY_9 : PLL_BY_16;
    if (start_pll(setting) && switch_to_pll(setting))
        return exact ? best : good;
    RCC.cfgr = 0;
    return slow;
}

uint32_t chip_reset_flags(void)
{
    uint32_t flags = RCC.csr;

    RCC.csr = flags | CSR_FORGET;
    return flags;
}
