/* flash.h: two pages of flash memory, as the flash store needs them. Exactly one implementation is linked in.
 *
 * Flash is written in units of some bytes, each unit once between two erases; zeros can be written over anything. An offset is
 * in bytes from the start of a page. Offsets and counts are multiples of flash_unit(). */
#ifndef OCTET_FLASH_H
#define OCTET_FLASH_H

#include <stdbool.h>
#include <stdint.h>

enum { FLASH_PAGES = 2, FLASH_UNIT_MAX = 32 };

bool flash_exists(void);
        /* False on a machine without flash to write to, as an emulator may be. Then nothing else here is called. */

uint32_t flash_page_size(void);
        /* In bytes, a multiple of 32, at most 32768. The same for both pages. */

uint32_t flash_unit(void);
        /* In bytes: 4, 8, 16 or 32. */

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count);
        /* Reads count bytes, as they lie there; erased ones are 0xFF. 0, or -1: the flash's own error correction finds
           something there that was never wholly written, and words holds anything. */

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count);
        /* Writes count bytes, unit by unit, the lowest first: erased ones, or any with zeros. 0: they read back as written. Else -1: whatever is
           there now, no other byte has changed; where the supply is low, none at all. Takes under 0.2 ms for each 4 bytes. */

int flash_erase(unsigned page);
        /* 0: the whole page is erased. Else -1, with nothing done where the supply is low. Takes up to 0.5 s, and on some
           machines nothing else goes on meanwhile. */

#endif
