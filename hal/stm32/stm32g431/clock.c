/* 80 MHz from the board's crystal, or from the internal 16 MHz.
 *
 * The chip can do 170 MHz, after a voltage boost and a rest at half speed; a tick takes 3,000 instructions, and from 80 MHz
 * a bit of CAN has 16 quanta. */
#include "hal/port/cortex_m/systick.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/comes_up.h"
#include "hal/stm32/stm32g431/registers.h"

#if OCTET_CRYSTAL_MHZ % 4 != 0
#error "the PLL's input is 4 MHz"
#endif

enum {
    CSR_FORGET = 1 << 23,
    HSEON = 1u << 16,
    HSERDY = 1u << 17,
    PLLON = 1u << 24,
    PLLRDY = 1u << 25,
    CFGR_SW_HSI = 1,
    CFGR_SW_PLL = 3,
    CFGR_SWS = 3u << 2,
    CFGR_SWS_PLL = 3u << 2,
    PLL_FROM_HSI = 2,
    PLL_FROM_HSE = 3,
    PLL_IN_MHZ = 4,
    PLL_N_40 = 40u << 8,         /* 160 MHz inside, */
    PLL_R_2 = 0u << 25,          /* halved: 80 MHz out */
    PLL_R_ON = 1u << 24,
    HSI_MHZ = 16,
    ACR_WAITS = 15,
    ACR_2_WAITS = 2,             /* up to 90 MHz without boost, 5.3.3 */
    ACR_CACHES = 3u << 8,        /* prefetch and instruction cache; a data cache would remember what the store was */
    ACR_DEBUGGER = 1u << 18
};

static bool start_crystal(void)
{
    RCC.cr |= HSEON;
    return comes_up(&RCC.cr, HSERDY, HSERDY, CRYSTAL_MS);
}

static bool start_pll(uint32_t source, uint32_t source_mhz)
{
    RCC.pllcfgr = PLL_R_2 | PLL_R_ON | PLL_N_40 | (source_mhz / PLL_IN_MHZ - 1) << 4 | source;
    RCC.cr |= PLLON;
    return comes_up(&RCC.cr, PLLRDY, PLLRDY, SWITCH_MS);
}

/* The flash is slowed down before the clock gets faster. */
static bool switch_to_pll(void)
{
    FLASH.acr = ACR_DEBUGGER | ACR_CACHES | ACR_2_WAITS;
    if (!comes_up(&FLASH.acr, ACR_WAITS, ACR_2_WAITS, SWITCH_MS))
        return false;
    RCC.cfgr = CFGR_SW_PLL;
    return comes_up(&RCC.cfgr, CFGR_SWS, CFGR_SWS_PLL, SWITCH_MS);
}

struct clocks clock_start(void)
{
    static const struct clocks best = {80000000, 80000000, 80000000, true};
    static const struct clocks good = {80000000, 80000000, 80000000, false};
    static const struct clocks slow = {16000000, 16000000, 16000000, false};
    bool exact, fast;

    systick_start(slow.core_hz);
    exact = start_crystal();
    fast = exact ? start_pll(PLL_FROM_HSE, OCTET_CRYSTAL_MHZ) : start_pll(PLL_FROM_HSI, HSI_MHZ);
    if (fast && switch_to_pll())
        return exact ? best : good;
    RCC.cfgr = CFGR_SW_HSI;
    return slow;
}

uint32_t chip_reset_flags(void)
{
    uint32_t flags = RCC.csr;

    RCC.csr = flags | CSR_FORGET;
    return flags;
}
