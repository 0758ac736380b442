/* The store in the last two sectors of the flash. A write is a whole page of it, whose other bits are 1 and stay. */
#include "hal/flash_store/flash.h"

#include "hal/port/cortex_m/uart.h"
#include "hal/rp2040/machine.h"

enum {
    SECTOR_COUNT = 64,        /* the last ones of the flash; the last two of these are pages 0 and 1 */
    SECTORS_AT = 0x1C0000,    /* where they are in the flash */
    FLASH_UNIT = 16
};

extern const volatile uint32_t SECTORS[];

/* Where a page begins among the sectors, in bytes. */
static uint32_t place(unsigned page)
{
    return (page < FLASH_PAGES ? SECTOR_COUNT - FLASH_PAGES + page : page - FLASH_PAGES) * ROM_SECTOR;
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
    for (uint32_t i = 0; i < count / 4; i++)
        words[i] = SECTORS[(place(page) + offset) / 4 + i];
    return 0;
}

static int write_unit(uint32_t begin, const uint32_t words[FLASH_UNIT / 4])
{
    uint32_t page[ROM_PAGE / 4], at = begin % ROM_PAGE / 4;

    for (uint32_t i = 0; i < ROM_PAGE / 4; i++)
        page[i] = i - at < FLASH_UNIT / 4 ? words[i - at] : UINT32_MAX;
    rom_write(SECTORS_AT + begin - 4 * at, page);
    line_pump();
    for (uint32_t i = 0; i < FLASH_UNIT / 4; i++)
        if (SECTORS[begin / 4 + i] != words[i])
            return -1;
    return 0;
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    int result = 0;

    for (uint32_t done = 0; done < count && result == 0; done += FLASH_UNIT)
        result = write_unit(place(page) + offset + done, &words[done / 4]);
    return result;
}

int flash_erase(unsigned page)
{
    rom_erase(SECTORS_AT + place(page));
    line_pump();
    for (uint32_t i = 0; i < ROM_SECTOR / 4; i++)
        if (SECTORS[place(page) / 4 + i] != UINT32_MAX)
            return -1;
    return 0;
}
