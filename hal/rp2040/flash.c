/* The store in the last two sectors of the flash. A write is a whole page of it, whose other bits are 1 and stay. */
#include "hal/flash_store/flash.h"

#include <string.h>

#include "hal/port/cortex_m/uart.h"
#include "hal/rp2040/rom.h"

enum {
    SECTOR_COUNT = 64,        /* the last ones of the flash; the last two of these are pages 0 and 1 */
    SECTORS_AT = 0x1C0000,    /* where they are in the flash */
    FLASH_UNIT = 16
};

extern const volatile uint8_t SECTORS[];

static const volatile uint8_t *place(unsigned page, uint32_t offset)
{
    unsigned sector = page < FLASH_PAGES ? SECTOR_COUNT - FLASH_PAGES + page : page - FLASH_PAGES;

    return &SECTORS[sector * ROM_SECTOR + offset];
}

static uint32_t in_flash(const volatile uint8_t *at)
{
    return SECTORS_AT + (uint32_t)(at - SECTORS);
}

bool flash_exists(void)
{
    return rom_exists();
}

uint32_t flash_page_size(void)
{
    return ROM_SECTOR;
}

uint32_t flash_unit(void)
{
    return FLASH_UNIT;
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    const volatile uint32_t *at = (const volatile uint32_t *)(const volatile void *)place(page, offset);

    for (uint32_t i = 0; i < count / 4; i++)
        words[i] = at[i];
    return 0;
}

static int compare(unsigned page, uint32_t offset, const uint8_t bytes[], uint32_t count)
{
    const volatile uint8_t *at = place(page, offset);

    for (uint32_t i = 0; i < count; i++)
        if (at[i] != bytes[i])
            return -1;
    return 0;
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    uint8_t bytes[ROM_PAGE];
    int result = 0;

    for (uint32_t done = 0; done < count && result == 0; done += FLASH_UNIT) {
        uint32_t at = (offset + done) % ROM_PAGE;

        memset(bytes, 0xFF, sizeof bytes);
        memcpy(&bytes[at], &words[done / 4], FLASH_UNIT);
        rom_write(in_flash(place(page, offset + done - at)), bytes);
        line_pump();
        result = compare(page, offset + done, &bytes[at], FLASH_UNIT);
    }
    return result;
}

int flash_erase(unsigned page)
{
    const volatile uint8_t *at = place(page, 0);

    rom_erase(in_flash(at));
    line_pump();
    for (uint32_t i = 0; i < ROM_SECTOR; i++)
        if (at[i] != 0xFF)
            return -1;
    return 0;
}
