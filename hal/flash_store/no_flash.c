/* A machine without flash that it can write: the robot forgets when it loses its power. */
#include "hal/flash_store/flash.h"

bool flash_exists(void)
{
    return false;
}

uint32_t flash_page_size(void)
{
    return 0;
}

uint32_t flash_unit(void)
{
    return 4;
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    (void)page;
    (void)offset;
    (void)words;
    (void)count;
    return -1;
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    (void)page;
    (void)offset;
    (void)words;
    (void)count;
    return -1;
}

int flash_erase(unsigned page)
{
    (void)page;
    return -1;
}
