/* The flash store: whatever the flash holds, and whichever of its operations fail. */
#include "hal/flash_store/flash.h"
#include "hal/flash_store/flash_store.h"
#include "tests/proof/any.h"

enum { PAGE_SIZE = 1024, UNIT = 8 };

bool flash_exists(void)
{
    return true;
}

uint32_t flash_page_size(void)
{
    return PAGE_SIZE;
}

uint32_t flash_unit(void)
{
    return UNIT;
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    for (uint32_t i = 0; i < count / sizeof words[0]; i++)
        words[i] = any_u32();
    return any_bool() ? 0 : -1;
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    for (uint32_t i = 0; i < count / sizeof words[0]; i++)
        (void)words[i];
    return any_bool() ? 0 : -1;
}

int flash_erase(unsigned page)
{
    //@ assert erases_a_page: page < FLASH_PAGES;
    (void)page;
    return any_bool() ? 0 : -1;
}

void exercise(void)
{
    struct flash_store store;
    uint8_t memory[CELL_COUNT] = {0};

    (void)flash_store_open(&store, memory);
    while (any_more()) {
        for (unsigned p = 0; p < CELL_COUNT; p++)
            memory[p] = any_u8();
        (void)flash_store_save(&store, memory, any_bool());
    }
}
