#include "tests/proof/any/flash.h"

#include "tests/proof/any/any.h"

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
    //@ assert reads_a_page: page < ANY_FLASH_PAGES;
    (void)page;
    (void)offset;
    for (uint32_t i = 0; i < count / sizeof words[0]; i++)
        words[i] = any_u32();
    return any_bool() ? 0 : -1;
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    //@ assert writes_a_page: page < ANY_FLASH_PAGES;
    (void)page;
    (void)offset;
    for (uint32_t i = 0; i < count / sizeof words[0]; i++)
        (void)words[i];
    return any_bool() ? 0 : -1;
}

int flash_erase(unsigned page)
{
    //@ assert erases_a_page: page < ANY_FLASH_PAGES;
    (void)page;
    return any_bool() ? 0 : -1;
}
