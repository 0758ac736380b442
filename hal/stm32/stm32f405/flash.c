/* Sectors 1 and 2 (RM0090 3.6). */
#include "hal/stm32/flash_table.h"
#include "hal/stm32/stm32f405/registers.h"

enum {
    SECTOR_SIZE = 16384,
    CR_SECTOR_AT = 3,
    CR_WORDS = 2 << 8           /* four bytes at once, for 2.7 V and more */
};

extern volatile uint32_t STORE[FLASH_PAGES][SECTOR_SIZE / 4];

const struct flash_table FLASH_TABLE = {
    .keyr = &FLASH.keyr, .sr = &FLASH.sr, .cr = &FLASH.cr, .supply = &PWR.csr,
    .supply_low = 1u << 2,
    .page_size = SECTOR_SIZE,
    .unit = 4,
    .at_once = 4,
    .erase_ms = 1000,
    .busy = 1u << 16,
    .errors = 0xF2,
    .done = 1u << 0,
    .lock = 1u << 31,
    .write = CR_WORDS | 1u << 0,
    .erase = CR_WORDS | 1u << 1 | 1u << CR_SECTOR_AT,
    .next_page = 1u << CR_SECTOR_AT,
    .start = 1u << 16,
};

volatile void *flash_place(unsigned page, uint32_t offset)
{
    return &STORE[page][offset / 4];
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    for (uint32_t i = 0; i < count / 4; i++)
        words[i] = STORE[page][offset / 4 + i];
    return 0;
}

void flash_begin(unsigned page, uint32_t offset, const uint32_t words[])
{
    STORE[page][offset / 4] = words[0];
}

bool flash_has(unsigned page, uint32_t offset, const uint32_t words[])
{
    return STORE[page][offset / 4] == words[0];
}
