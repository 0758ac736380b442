#include "hal/stm32/chip.h"

#include "hal/port/cortex_m/systick.h"

/* Common to all chips. */
enum {
    HSEON = 1u << 16,   /* CR */
    HSERDY = 1u << 17,
    PLLON = 1u << 24,
    PLLRDY = 1u << 25,
    SWS = 3u << 2       /* CFGR */
};

static const struct clock_table *const chip = &CLOCK_TABLE;

/* Waits for bits of a register. Returns false if they do not reach the wanted value in time. */
static bool comes_up(volatile const uint32_t *reg, uint32_t mask, uint32_t wanted, uint32_t limit_ms)
{
    uint32_t start = machine_ms();

    while ((*reg & mask) != wanted)
        if (machine_ms() - start > limit_ms)
            return false;
    return true;
}

static bool start_crystal(void)
{
    *chip->cr |= HSEON;
    return comes_up(chip->cr, HSERDY, HSERDY, CRYSTAL_MS);
}

static bool start_pll(uint32_t setting)
{
    if (chip->buses != chip->internal)
        *chip->cfgr = chip->buses;
    *chip->pll = setting;
    *chip->cr |= PLLON;
    return comes_up(chip->cr, PLLRDY, PLLRDY, SWITCH_MS);
}

/* Slows down the flash, which confirms it (RM0090 3.5.1), before raising the clock. */
static bool switch_to_pll(uint32_t setting)
{
    *chip->acr = chip->caches | chip->waits;
    if (!comes_up(chip->acr, chip->waits_mask, chip->waits, SWITCH_MS))
        return false;
    *chip->cfgr = (chip->pll == chip->cfgr ? setting : chip->buses) | chip->switch_to_pll;
    return comes_up(chip->cfgr, SWS, chip->from_pll, SWITCH_MS);
}

struct clocks clock_start(void)
{
    const struct clock_source *source;

    /* An emulator without a clock controller, as QEMU's, runs at full speed at once. */
    if (chip->on_after_reset && !(*chip->cr & chip->on_after_reset))
        return CLOCK_SOURCES[1].clocks;
    systick_start(CLOCK_SLOW.core_hz, CLOCK_SYSTICK_DIVISOR);
    *chip->acr = chip->caches | (*chip->acr & chip->waits_mask);   /* a reset may leave a data cache on */
    source = &CLOCK_SOURCES[start_crystal() ? 1 : 0];
    if (start_pll(source->pll) && switch_to_pll(source->pll))
        return source->clocks;
    *chip->cfgr = chip->internal;
    return CLOCK_SLOW;
}

uint32_t chip_reset_flags(void)
{
    uint32_t flags = *chip->csr;

    *chip->csr = flags | chip->forget;
    return flags & chip->brown_out ? flags | CHIP_POWER_ON : flags;
}
