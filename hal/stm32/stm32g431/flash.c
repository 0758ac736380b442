/* 64 pages, the last two for the store (RM0440 5.3).
 *
 * Eight bytes are written at once, with eight bits of error correction. A write interrupted by a power failure can
 * leave eight bytes with an uncorrectable error: reading them raises a non-maskable interrupt. */
#include "hal/stm32/chip.h"
#include "hal/stm32/stm32g431/registers.h"

enum {
    PAGE_SIZE = 2048,
    FIRST_PAGE = 62,
    INTERRUPT_MAX = 100        /* polls of a flag until its interrupt has arrived, within a few cycles */
};

static const uint32_t ECCR_TWO_BITS = 1u << 31;

extern volatile uint32_t STORE[][PAGE_SIZE / 4], PAGES[][PAGE_SIZE / 4];

const struct flash_table FLASH_TABLE = {
    .keyr = &FLASH.keyr, .sr = &FLASH.sr, .cr = &FLASH.cr, .supply = &PWR.sr2,
    .supply_low = 1u << 11,
    .page_size = PAGE_SIZE,
    .unit = 8,
    .at_once = 8,               /* the second word starts the write */
    .erase_ms = 100,
    .busy = 1u << 16,
    .errors = 0xC3FA,
    .done = 1u << 0,
    .lock = 1u << 31,
    .write = 1u << 0,
    .erase = 1u << 1,
    .number_at = 3,
    .start = 1u << 16,
};

static volatile bool reading, unreadable;

bool flash_forgives(void);

/* Whether flash_read expected this error and will report it, so that the program continues; else it is another one,
 * or at another place. Called by assembly in nmi.c, which the linker cannot see. */
__attribute__((used)) bool flash_forgives(void)
{
    if (!reading || !(FLASH.eccr & ECCR_TWO_BITS))
        return false;
    FLASH.eccr = ECCR_TWO_BITS;
    unreadable = true;
    return true;
}

__attribute__((noinline)) volatile void *flash_place(unsigned page, uint32_t offset)
{
    return page < FLASH_PAGES ? &STORE[page][offset / 4] : &PAGES[page - FLASH_PAGES][offset / 4];
}

uint32_t flash_number(unsigned page)
{
    return page < FLASH_PAGES ? FIRST_PAGE + page : page - FLASH_PAGES;
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    const volatile uint32_t *at = flash_place(page, offset);

    unreadable = false;
    reading = true;
    for (uint32_t i = 0; i < count / 4; i++)
        words[i] = at[i];
    for (unsigned i = 0; i < INTERRUPT_MAX && FLASH.eccr & ECCR_TWO_BITS; i++)
        continue;
    reading = false;
    return unreadable || FLASH.eccr & ECCR_TWO_BITS ? -1 : 0;
}

void flash_begin(unsigned page, uint32_t offset, const uint32_t words[])
{
    volatile uint32_t *at = flash_place(page, offset);

    at[0] = words[0];
    at[1] = words[1];
}

bool flash_has(unsigned page, uint32_t offset, const uint32_t words[])
{
    uint32_t found[2];

    return flash_read(page, offset, found, sizeof found) == 0 && found[0] == words[0] && found[1] == words[1];
}
