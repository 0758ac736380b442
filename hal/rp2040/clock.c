/* From the ring oscillator, on which the chip starts, to the crystal and the PLL (data sheet 2.15 to 2.18). */
#include "hal/rp2040/machine.h"

#include "hal/rp2040/registers.h"

enum {
    CRYSTAL_RANGE = 0xAA0,              /* 1 to 15 MHz */
    CRYSTAL_ON = 0xFAB << 12,
    CRYSTAL_SETTLES = 282,              /* 6 ms in 256 cycles of it: data sheet 2.16.3 has 1 ms as the least */
    REF_BY_CRYSTAL = 2,                 /* in clk_ref.ctrl, and the number of its bit in `selected` */
    SYS_BY_REF = 0, SYS_BY_PLL = 1,     /* the same of clk_sys */
    PERI_ON = 1 << 11,                  /* by clk_sys */
    ADC_ON = 1 << 11,                   /* by PLL_USB */
    RESET_PLL_SYS = 1 << 12,
    RESET_PLL_USB = 1 << 13,
    PLL_FACTOR = 125,                   /* 12 MHz, which the reset leaves undivided, to 1500 MHz, */
    PLL_DIVIDERS = 6 << 16 | 2 << 12,   /* and by 6 and 2 to 125 MHz, */
    ADC_FACTOR = 100,                   /* or to 1200 MHz, */
    ADC_DIVIDERS = 5 << 16 | 5 << 12,   /* and by 5 and 5 to 48 MHz */
    PLL_OFF = 1 << 0, PLL_DIVIDERS_OFF = 1 << 3, PLL_VCO_OFF = 1 << 5,
    RING_HZ = 6500000, CRYSTAL_HZ = 12000000, PLL_HZ = 125000000
};

static const uint32_t READY = 1u << 31;   /* of crystal and PLL */

static bool await(const volatile uint32_t *reg, uint32_t bits)
{
    for (unsigned i = 0; i < CLOCK_WAIT_MAX; i++)
        if ((*reg & bits) == bits)
            return true;
    return false;
}

static bool select_source(volatile struct clock_generator *clock, uint32_t source)
{
    clock->ctrl = source;
    return await(&clock->selected, 1u << source);
}

void clock_release(uint32_t blocks)
{
    RESETS.reset &= ~blocks;
    (void)await(&RESETS.reset_done, blocks);
}

static bool start_crystal(void)
{
    XOSC.startup = CRYSTAL_SETTLES;
    XOSC.ctrl = CRYSTAL_RANGE | CRYSTAL_ON;
    return await(&XOSC.status, READY) && select_source(&CLOCKS.clk_ref, REF_BY_CRYSTAL);
}

static bool start_pll(volatile struct pll_registers *pll, uint32_t block, uint32_t factor, uint32_t dividers)
{
    RESETS.reset |= block;
    clock_release(block);
    pll->fbdiv_int = factor;
    pll->pwr &= ~((uint32_t)PLL_OFF | PLL_VCO_OFF);
    if (!await(&pll->cs, READY))
        return false;
    pll->prim = dividers;
    pll->pwr &= ~(uint32_t)PLL_DIVIDERS_OFF;
    return true;
}

static bool start_core(void)
{
    return start_pll(&PLL_SYS, RESET_PLL_SYS, PLL_FACTOR, PLL_DIVIDERS)
        && select_source(&CLOCKS.clk_sys, SYS_BY_PLL);
}

bool clock_start_adc(void)
{
    bool starts = start_pll(&PLL_USB, RESET_PLL_USB, ADC_FACTOR, ADC_DIVIDERS);

    CLOCKS.clk_adc.ctrl = starts ? (uint32_t)ADC_ON : 0;
    return starts;
}

/* A debugger's reset leaves the core on the PLL, which is started anew: so it first leaves it. */
struct clocks clock_start(void)
{
    struct clocks clocks = {RING_HZ, false};

    (void)select_source(&CLOCKS.clk_sys, SYS_BY_REF);
    if (start_crystal())
        clocks = (struct clocks){start_core() ? (uint32_t)PLL_HZ : (uint32_t)CRYSTAL_HZ, true};
    CLOCKS.clk_peri.ctrl = PERI_ON;
    return clocks;
}
