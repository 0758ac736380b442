/* flash.h: two pages of flash memory, as the flash store needs them. Exactly one implementation is linked in. */
#ifndef OCTET_FLASH_H
#define OCTET_FLASH_H

#include <stdbool.h>
#include <stdint.h>

enum { FLASH_PAGES = 2 };

bool flash_exists(void);
        /* False on a machine without flash to write to, as an emulator may be. Then nothing else here is called. */

uint32_t flash_page_size(void);
        /* In bytes, a multiple of 16. The same for both pages. */

const void *flash_page(unsigned page);
        /* The page's bytes as they are now, 4-aligned. Erased ones are 0xFF. */

int flash_write(unsigned page, uint32_t offset, uint32_t word);
        /* Writes four erased bytes at a multiple of 4, lowest first. 0: they read back as written. Else -1: whatever is
           there now, no other byte has changed. Takes under 0.2 ms. */

int flash_erase(unsigned page);
        /* 0: the whole page is erased. Else -1. Takes up to 0.8 s, and on some machines nothing else goes on meanwhile. */

#endif
