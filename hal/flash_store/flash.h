/* flash.h: pages of flash memory, as the flash store needs them. Exactly one implementation is linked in.
 *
 * Pages 0 and 1 belong to the store of the memory. On a chip with a body on pins, page FLASH_PAGES + n is the chip's
 * nth page, of the same size.
 *
 * Flash is written in units of some bytes, each unit once between two erases; zeros can be written over anything. An
 * offset is in bytes from the start of a page. Offsets and counts are multiples of flash_unit(). */
#ifndef OCTET_FLASH_H
#define OCTET_FLASH_H

#include <stdbool.h>
#include <stdint.h>

enum { FLASH_PAGES = 2, FLASH_UNIT_MAX = 32, FLASH_UNIT_WORDS = FLASH_UNIT_MAX / 4 };

bool flash_exists(void);
        /* False on a machine without writable flash, such as some emulators. Then nothing else here may be called. */

uint32_t flash_page_size(void);
        /* In bytes, a multiple of 32, at most 32768. The same for both pages. */

uint32_t flash_unit(void);
        /* In bytes: 4, 8, 16 or 32. */

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count);
        /* Reads count bytes; erased ones are 0xFF. Returns 0, or -1 if the flash's error correction reports a partial
           write; words is then undefined. */

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count);
        /* Writes count bytes unit by unit, lowest first: over erased bytes, or zeros over any. Returns 0 if they read
           back as written. Otherwise -1: these bytes are undefined, and no other byte has changed; if the supply is
           low, none at all. Takes under 0.2 ms per 4 bytes. */

int flash_erase(unsigned page);
        /* Returns 0 if the whole page is erased, else -1; if the supply is low, it does nothing. Takes up to 0.5 s,
           during which some machines stall. */

#endif
