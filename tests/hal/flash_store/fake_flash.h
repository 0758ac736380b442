/* fake_flash.h: four small pages of flash in RAM, of any write unit, whose power fails on plan. */
#ifndef OCTET_FAKE_FLASH_H
#define OCTET_FAKE_FLASH_H

#include <setjmp.h>
#include <stdint.h>

#include "hal/flash_store/flash.h"

enum {
    FAKE_PAGES = 2 * FLASH_PAGES,  /* of two stores */
    FAKE_RECORDS = 4,              /* of a page */
    FAKE_PAGE_MAX = FLASH_UNIT_MAX * FAKE_RECORDS
};

struct fake_flash_kind {
    uint32_t unit;          /* as flash_unit */
    uint32_t step;          /* bytes that the flash itself writes at once, a part of the unit or all of it */
    bool corrects;          /* with error correction: what was cut short can be unreadable */
};

struct fake_flash {
    struct fake_flash_kind kind;
    uint8_t bytes[FAKE_PAGES][FAKE_PAGE_MAX];
    uint32_t unreadable[FAKE_PAGES];   /* bit n: word n */
    unsigned operations;        /* so far: each step written, each page erased */
    unsigned cut_at;            /* power fails within this one, counted from 1; 0: never */
    unsigned damage;            /* how far it gets then: FAKE_DAMAGES kinds */
    jmp_buf cut;                /* and control goes here */
    unsigned writes, erases;
    bool erase_fails;
    bool erase_does_nothing;    /* and says that it did */
    bool write_fails;           /* says so, though all is written */
    bool weak[FAKE_PAGES];     /* its erase was cut short: what is written there decays, and nobody may */
    uint8_t worn[FAKE_PAGES];  /* bit r: record r of the page takes no writes */
};

enum { FAKE_DAMAGES = 5 };      /* not begun, half done, nearly or wholly done, unreadable where that can be, half otherwise */

extern struct fake_flash fake_flash;

void fake_flash_clear(const struct fake_flash_kind *kind);
        /* All erased, nothing fails. */

uint32_t fake_flash_place(void);
        /* Bytes from one record to the next. */

#endif
