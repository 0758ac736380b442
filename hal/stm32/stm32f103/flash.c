/* 64 pages, the last two for the store (PM0075 2.3), written by half-words. */
#include "hal/stm32/chip.h"
#include "hal/stm32/stm32f103/registers.h"

enum { PAGE_SIZE = 1024 };

extern volatile uint16_t STORE[], PAGES[];

const struct flash_table FLASH_TABLE = {
    .keyr = &FLASH.keyr, .sr = &FLASH.sr, .cr = &FLASH.cr, .ar = &FLASH.ar, .supply = &PWR.csr,
    .supply_low = 1u << 2,
    .page_size = PAGE_SIZE,
    .unit = 4,                   /* two half-words, one after the other */
    .at_once = 2,
    .erase_ms = 100,
    .busy = 1u << 0,
    .errors = 1u << 2 | 1u << 4,
    .done = 1u << 5,
    .lock = 1u << 7,
    .write = 1u << 0,
    .erase = 1u << 1,
    .start = 1u << 6,
    .slow = true,
};

volatile void *flash_place(unsigned page, uint32_t offset)
{
    uint32_t at = page < FLASH_PAGES ? page : page - FLASH_PAGES;
    volatile uint16_t *start = page < FLASH_PAGES ? STORE : PAGES;

    return &start[(at * PAGE_SIZE + offset) / 2];
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    const volatile uint16_t *at = flash_place(page, offset);

    for (uint32_t i = 0; i < count / 4; i++)
        words[i] = at[2 * i] | (uint32_t)at[2 * i + 1] << 16;
    return 0;
}

void flash_begin(unsigned page, uint32_t offset, const uint32_t words[])
{
    *(volatile uint16_t *)flash_place(page, offset) = (uint16_t)words[0];
}

/* A page is selected by its address. */
uint32_t flash_number(unsigned page)
{
    (void)page;
    return 0;
}

bool flash_has(unsigned page, uint32_t offset, const uint32_t words[])
{
    return *(volatile uint16_t *)flash_place(page, offset) == (uint16_t)words[0];
}
