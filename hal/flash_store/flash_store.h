/* flash_store.h: the robot's memory in two pages of flash, so that no loss of power at any moment harms it.
 *
 * Each change appends a record of 16 bytes: a number, one more for each record, which wraps; the eight bytes; a CRC-32 over
 * both; and 0xFF as far as the flash's write unit is longer. The newest whole record counts. One that was cut short, or lies
 * on worn cells, cannot be read, fails its CRC or does not read back; it is passed over and stays where it is. Nothing is
 * erased to make room but the page that does not hold the newest whole record, and that only when the page in use is full,
 * once for as many changes as a page has records (64 on an F103, 1024 on an F405, 128 on a G431). Because an erase stops the
 * machine for up to 0.8 s, it is left to a moment when the wheels stand and nobody waits for an answer; until then the old
 * memory is what a loss of power leaves.
 *
 * What the eight bytes mean is the robot's business: they are kept as they are, and no older record takes the place of one
 * whose bytes the robot does not like. */
#ifndef OCTET_FLASH_STORE_H
#define OCTET_FLASH_STORE_H

#include "hal/hal.h"

struct flash_store {
    uint32_t number;   /* of the newest whole record */
    uint16_t newest;   /* where it is in the page that holds it, in bytes; FLASH_STORE_NOWHERE: there is none */
    uint16_t next;     /* where the next record goes in the page in use */
    uint8_t page;      /* in use: this or that */
    uint8_t kept;      /* holds the newest whole record, if there is one */
};

enum { FLASH_STORE_NOWHERE = UINT16_MAX };

int flash_store_open(struct flash_store *store, uint8_t memory[CELL_COUNT]);
        /* Looks at all records. As hal_load: 1, 0 where both pages are blank, or HAL_E_STORE where there is no whole
           record. The store is ready in each case. */

enum { FLASH_STORE_LATER = 1 };

int flash_store_save(struct flash_store *store, const uint8_t memory[CELL_COUNT], bool may_erase);
        /* 0: stored; nothing is written if the newest record holds the same bytes. FLASH_STORE_LATER: it takes an erase,
           and may_erase is false; nothing has changed. HAL_E_STORE: the flash does not take it; what was stored before
           still counts. */

#endif
