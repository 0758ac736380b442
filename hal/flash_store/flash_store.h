/* flash_store.h: the robot's memory in two pages of flash, safe against a loss of power at any moment.
 *
 * Each change appends a record of 16 bytes: a sequence number, which wraps; the eight bytes; a CRC-32 over both; and
 * padding of 0xFF up to the flash's write unit. Each attempt takes the next number, so that one that seemed to fail
 * but reads well later never counts as newer than one saved after it. The newest valid record counts. A record cut
 * short or on worn cells is unreadable, fails its CRC or does not read back; it is skipped and stays where it is.
 *
 * Only the page without the newest valid record is ever erased, and only when the one in use is full: once per as
 * many changes as a page has records, less the mark (63 on an F103, 1023 on an F405, 127 on a G431). A page whose
 * erase lost power can read blank yet soon lose what is written to it. So a completed erase is marked in the page's
 * first place, and a blank page without a mark is erased again. Zeros overwrite the mark before an erase, so that an
 * interrupted one cannot leave it. An erase stalls the machine for up to 0.5 s, so it waits for the next start, or
 * until the wheels are at rest and no answer is awaited; until then, a power loss brings back the old memory.
 *
 * The store does not interpret the eight bytes. If the robot rejects the newest record, no older one replaces it. */
#ifndef OCTET_FLASH_STORE_H
#define OCTET_FLASH_STORE_H

#include "hal/hal.h"

struct flash_store {
    uint32_t number;   /* of the last attempt */
    uint16_t newest;   /* offset of the newest valid record in its page, bytes; FLASH_STORE_NOWHERE: none */
    uint16_t next;     /* offset of the next record in the page in use, bytes */
    uint8_t first;     /* of its two pages */
    uint8_t page;      /* the page in use */
    uint8_t kept;      /* the page with the newest valid record, if any */
};

enum { FLASH_STORE_NOWHERE = UINT16_MAX };

int flash_store_open(struct flash_store *store, uint8_t memory[CELL_COUNT]);
        /* Scans all records. Returns 1 if it has loaded a memory, 0 if both pages are blank, or HAL_E_STORE if none
           is valid. If there is no room for another record, erases the page that can be spared. The store is usable
           in each case. */

int flash_store_open_at(struct flash_store *store, unsigned first_page, uint8_t bytes[CELL_COUNT]);
        /* The same for another store of eight bytes, in that page and the next. */

enum { FLASH_STORE_LATER = 1 };

int flash_store_save(struct flash_store *store, const uint8_t memory[CELL_COUNT], bool may_erase);
        /* 0: stored; nothing is written if the newest record holds the same bytes. FLASH_STORE_LATER: an erase is
           needed, but may_erase is false; nothing has changed. HAL_E_STORE: the write failed; the old bytes still
           count, or after a reset possibly the new ones, until the next save. */

#endif
