/* Sectors 1 and 2 are for the store (RM0090 3.6). */
#include "hal/stm32/chip.h"
#include "hal/stm32/stm32f405/registers.h"

enum {
    SECTOR_SIZE = 16384,
    FIRST_SECTOR = 1,
    CR_WORDS = 2 << 8           /* four bytes at once, for 2.7 V and above */
};

extern volatile uint32_t STORE[][SECTOR_SIZE / 4];

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
    .erase = CR_WORDS | 1u << 1,
    .number_at = 3,
    .start = 1u << 16,
};

__attribute__((noinline)) volatile void *flash_place(unsigned page, uint32_t offset)   /* not inlined, to save code */
{
    return &STORE[page][offset / 4];
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    const volatile uint32_t *at = flash_place(page, offset);

    for (uint32_t i = count / 4; i-- > 0;)
        words[i] = at[i];
    return 0;
}

void flash_begin(unsigned page, uint32_t offset, const uint32_t words[])
{
    *(volatile uint32_t *)flash_place(page, offset) = words[0];
}

uint32_t flash_number(unsigned page)
{
    return FIRST_SECTOR + page;
}

bool flash_has(unsigned page, uint32_t offset, const uint32_t words[])
{
    return *(volatile uint32_t *)flash_place(page, offset) == words[0];
}
