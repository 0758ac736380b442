/* flash_store.h: the robot's memory in two pages of flash, so that no loss of power at any moment harms it.
 *
 * Each change appends a record of 16 bytes: a number, which wraps; the eight bytes; a CRC-32 over both; and 0xFF as far as
 * the flash's write unit is longer. Each try takes the next number, so that a record which seemed to fail and reads well after
 * all never passes for newer than what was saved later. The newest whole record counts. One that was cut short, or lies on worn
 * cells, cannot be read, fails its CRC or does not read back; it is passed over and stays where it is.
 *
 * Nothing is erased to make room but the page that does not hold the newest whole record, and that only when the page in use is
 * full: once for as many changes as a page has records, less the mark (63 on an F103, 1023 on an F405, 127 on a G431). An erase
 * that lost its power can leave a page that reads blank and soon loses what is written to it, so that a mark in the first place
 * tells an erase that came to its end; a blank page without one is erased again. The mark is overwritten with zeros before the
 * erase: one that is cut short cannot leave it standing. Because an erase stops the machine for up to
 * 0.5 s, it is left to the start, or to a moment when the wheels are at rest and no answer is awaited; until then the old
 * memory is what a loss of power leaves.
 *
 * What the eight bytes mean is for the robot to judge: they are kept as they are, and no older record takes the place of one
 * that the robot does not accept. */
#ifndef OCTET_FLASH_STORE_H
#define OCTET_FLASH_STORE_H

#include "hal/hal.h"

struct flash_store {
    uint32_t number;   /* of the last try */
    uint16_t newest;   /* where it is in the page that holds it, in bytes; FLASH_STORE_NOWHERE: there is none */
    uint16_t next;     /* where the next record goes in the page in use */
    uint8_t first;     /* of its two pages */
    uint8_t page;      /* in use: this or that */
    uint8_t kept;      /* holds the newest whole record, if there is one */
};

enum { FLASH_STORE_NOWHERE = UINT16_MAX };

int flash_store_open(struct flash_store *store, uint8_t memory[CELL_COUNT]);
        /* Looks at all records. As hal_load: 1, 0 where both pages are blank, or HAL_E_STORE where there is no whole
           record. Where there is no room for another one, erases the page that can be spared. The store is ready in
           each case. */

int flash_store_open_at(struct flash_store *store, unsigned first_page, uint8_t bytes[CELL_COUNT]);
        /* The same for another store, of eight bytes for whoever wants them, in that page and the next. */

enum { FLASH_STORE_LATER = 1 };

int flash_store_save(struct flash_store *store, const uint8_t memory[CELL_COUNT], bool may_erase);
        /* 0: stored; nothing is written if the newest record holds the same bytes. FLASH_STORE_LATER: it takes an erase,
           and may_erase is false; nothing has changed. HAL_E_STORE: the flash does not take it; what was stored before
           still counts, or after a reset perhaps this, until the next save. */

#endif
