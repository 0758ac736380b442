/* flash_store.h: the robot's memory in two pages of flash, so that no loss of power at any moment harms it.
 *
 * Each change appends a record: a number, one more for each record; the eight bytes; a CRC-32 over both. The whole record
 * with the highest number counts. One that was cut short, or lies on worn cells, fails its CRC or does not read back; it is
 * passed over and stays where it is. Nothing is erased to make room but the page that does not hold the newest whole
 * record, and that only when the page in use is full, once for as many changes as a page has records (64 on an F103, 1024
 * on an F405). Because an erase stops the machine for up to 0.8 s, it is left to a moment when the wheels stand and nobody
 * waits for an answer; until then the old memory is what a loss of power leaves. */
#ifndef OCTET_FLASH_STORE_H
#define OCTET_FLASH_STORE_H

#include "hal/hal.h"

struct flash_store {
    uint32_t number;   /* of the newest whole record; 0: there is none */
    uint32_t next;     /* place for the next record in page, counted in records */
    uint8_t page;      /* in use: this or that */
    uint8_t kept;      /* holds the newest whole record, if there is one */
};

int flash_store_open(struct flash_store *store, uint8_t memory[CELL_COUNT]);
        /* Looks at all records. As hal_load: 1, 0 where both pages are blank, or HAL_E_STORE where there is no whole
           record. The store is ready in each case. */

enum { FLASH_STORE_LATER = 1 };

int flash_store_save(struct flash_store *store, const uint8_t memory[CELL_COUNT], bool may_erase);
        /* 0: stored. FLASH_STORE_LATER: it takes an erase, and may_erase is false; nothing has changed. HAL_E_STORE: the
           flash does not take it; what was stored before still counts. */

#endif
