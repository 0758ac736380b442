/* flash_model.h: the flash controller that our chips have alike, behind registers in the test's memory. It looks at them, and a
 * millisecond passes, whenever the driver looks at the clock. To be included once, behind what is expected of a chip. */
#ifndef OCTET_FLASH_MODEL_H
#define OCTET_FLASH_MODEL_H

#include <stdbool.h>
#include <string.h>

#include "hal/port/cortex_m/uart.h"
#include "hal/stm32/chip.h"

static const uint32_t LAST_KEY = 0xCDEF89AB, MARK = 1u << 30;   /* a bit of SR that means nothing: what lacks it was written */

static struct {
    uint32_t now_ms, since_ms;
    uint32_t busy_ms;          /* that an operation takes */
    uint32_t fails;            /* flag that operations end with, else DONE */
    uint32_t flags, outcome;   /* of SR: what it shows, and what it will when the operation has ended */
    unsigned operations;
    bool unlocked;
    volatile store_word *worn; /* keeps nothing but this: */
    store_word worn_to;
    store_word before[FLASH_PAGES][STORE_WORDS];
} model;

void line_pump(void)
{
}

static void remember(void)
{
    memcpy(model.before, (const void *)STORE, sizeof STORE);
}

static void model_reset(void)
{
    memset(&model, 0, sizeof model);
    memset((void *)&FLASH, 0, sizeof FLASH);
    supply(false);
    memset((void *)STORE, 0xFF, sizeof STORE);
    remember();
    FLASH.cr = LOCK;
    FLASH.sr = MARK;
    model.now_ms = 1000000;
}

static void begin(bool allowed)
{
    model.operations++;
    model.since_ms = model.now_ms;
    model.outcome = !allowed ? ONE_ERROR : model.fails != 0 ? model.fails : (uint32_t)DONE;
}

static void take_write(void)
{
    bool allowed = model.unlocked && FLASH.cr == WRITING;

    if (!allowed)
        memcpy((void *)STORE, model.before, sizeof STORE);
    else if (model.worn)
        *model.worn = model.worn_to;
    remember();
    begin(allowed);
}

static void take_erase(void)
{
    int page = page_asked_for();
    bool allowed = model.unlocked && page >= 0 && page < FLASH_PAGES;

    if (allowed && model.fails == 0)
        memset((void *)STORE[page], 0xFF, sizeof STORE[page]);
    remember();
    FLASH.cr &= ~(uint32_t)START;
    begin(allowed);
}

static void take_requests(void)
{
    if (!(FLASH.sr & MARK))
        model.flags &= ~FLASH.sr;
    model.unlocked |= FLASH.keyr == LAST_KEY;
    FLASH.keyr = 0;
    if (FLASH.cr & START)
        take_erase();
    else if (memcmp(model.before, (const void *)STORE, sizeof STORE) != 0)
        take_write();
}

uint32_t machine_ms(void)
{
    bool busy;

    take_requests();
    busy = model.outcome != 0 && model.now_ms - model.since_ms < model.busy_ms;
    if (!busy) {
        model.flags |= model.outcome;
        model.outcome = 0;
    }
    FLASH.sr = MARK | model.flags | (busy ? BUSY : 0u);
    return model.now_ms++;
}

#endif
