/* clock_model.h: the clock controller that our chips have alike, behind registers in the test's memory. It looks at them, and a
 * millisecond passes, whenever the driver looks at the clock. To be included once, behind the registers of a chip. */
#ifndef OCTET_CLOCK_MODEL_H
#define OCTET_CLOCK_MODEL_H

#include <string.h>

#include "hal/port/cortex_m/systick.h"

enum {
    HSION = 1 << 0, HSEON = 1 << 16, HSERDY = 1 << 17, PLLON = 1 << 24, PLLRDY = 1 << 25,
    WAITS_MASK = 15, SWITCHED_AT = 2, NEVER = 1 << 30
};

volatile struct rcc_registers RCC;
volatile struct flash_registers FLASH;

static struct {
    uint32_t crystal_ms, pll_ms, switch_ms;   /* how long each takes; NEVER: it fails */
    uint32_t crystal_on_ms, pll_on_ms, switched_ms;   /* when each began */
    uint32_t now_ms, systick_hz;
    uint32_t switches;                        /* how often the clock got faster or slower, */
    uint32_t cfgr_before;                     /* and what CFGR was before the first time */
    uint32_t flash_ms;                        /* how long the flash takes to accept its wait states; NEVER: it does not */
    uint32_t waits, waits_wanted;             /* those that it has accepted, and those last written, */
    uint32_t waits_written_ms;                /* and when */
    uint32_t waits_when_switched;             /* of the flash, when the clock got faster */
    uint32_t others_on;                       /* bits of CR that the driver has set beside those it needs */
} model;

static void model_reset(void)
{
    memset(&model, 0, sizeof model);
    memset((void *)&RCC, 0, sizeof RCC);
    memset((void *)&FLASH, 0, sizeof FLASH);
    RCC.cr = HSION;
}

void systick_start(uint32_t core_hz, uint32_t divisor)
{
    TEST_ASSERT_EQUAL_UINT32(8, divisor);
    model.systick_hz = core_hz;
}

static void start(uint32_t on, uint32_t ready, uint32_t *since, uint32_t span_ms)
{
    if (!(RCC.cr & on))
        *since = model.now_ms + 1;   /* the next look is the first that can see it on */
    else if (model.now_ms - *since >= span_ms)
        RCC.cr |= ready;
}

static void accept_waits(void)
{
    uint32_t shown = FLASH.acr & WAITS_MASK;

    if (shown != model.waits) {
        model.waits_wanted = shown;
        model.waits_written_ms = model.now_ms;
    }
    if (model.now_ms - model.waits_written_ms >= model.flash_ms)
        model.waits = model.waits_wanted;
    FLASH.acr = (FLASH.acr & ~(uint32_t)WAITS_MASK) | model.waits;
}

uint32_t machine_ms(void)
{
    accept_waits();
    model.others_on |= RCC.cr & ~(uint32_t)(HSION | HSEON | HSERDY | PLLON | PLLRDY);
    start(HSEON, HSERDY, &model.crystal_on_ms, model.crystal_ms);
    start(PLLON, PLLRDY, &model.pll_on_ms, model.pll_ms);
    if ((RCC.cfgr & 3u) == (RCC.cfgr >> SWITCHED_AT & 3u)) {
        model.switched_ms = model.now_ms + 1;
        model.cfgr_before = model.switches == 0 ? RCC.cfgr : model.cfgr_before;
    } else if (model.now_ms - model.switched_ms >= model.switch_ms) {
        RCC.cfgr = (RCC.cfgr & ~(3u << SWITCHED_AT)) | (RCC.cfgr & 3u) << SWITCHED_AT;
        model.switches++;
        model.waits_when_switched = FLASH.acr & WAITS_MASK;
    }
    return model.now_ms++;
}

#endif
