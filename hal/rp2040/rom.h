/* rom.h: the boot ROM's functions for the flash (data sheet 2.8.3). While one works, the flash cannot be read: so
 * what calls them runs from RAM. No interrupt is ever taken, and the other core sleeps in the ROM. */
#ifndef OCTET_RP2040_ROM_H
#define OCTET_RP2040_ROM_H

#include <stdbool.h>
#include <stdint.h>

enum { ROM_SECTOR = 4096, ROM_PAGE = 256 };   /* what is erased at once, and written at once, in bytes */

bool rom_exists(void);
        /* False where the ROM's table is not there, as in some emulators. Then nothing else here may be called. */

void rom_erase(uint32_t offset);
        /* Erases the sector at that offset in the flash, in some 50 ms, at most 400 ms. */

void rom_write(uint32_t offset, const uint32_t page[ROM_PAGE / 4]);
        /* Clears the bits of a page that are 0 in page, which lies in RAM; in some 0.5 ms, at most 3 ms. */

#endif
