/* flash_store_rig.h: a store in a fake flash with injected faults, and what a start loads from it. */
#ifndef OCTET_FLASH_STORE_RIG_H
#define OCTET_FLASH_STORE_RIG_H

#include "hal/flash_store/flash.h"
#include "hal/flash_store/flash_store.h"

#include <setjmp.h>
#include <stdint.h>

/* Four small pages of flash in RAM, of any write unit, with a power cut at a given operation. */

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
    bool erase_does_nothing;    /* and reports success */
    bool write_fails;           /* reports failure, though all is written */
    bool weak[FAKE_PAGES];     /* its erase was cut short: it must not be written */
    uint8_t worn[FAKE_PAGES];  /* bit r: record r of the page takes no writes */
};

enum { FAKE_DAMAGES = 5 };      /* not begun, half done, nearly or wholly done, unreadable where that can be, half otherwise */

extern struct fake_flash fake_flash;

void fake_flash_clear(const struct fake_flash_kind *like);
        /* All erased, nothing fails. */

uint32_t fake_flash_place(void);
        /* Bytes from one record to the next. */

extern const struct fake_flash_kind KINDS[5];

#define FOR_EACH_KIND for (kind = KINDS; kind < KINDS + sizeof KINDS / sizeof KINDS[0]; kind++)

enum { CHANGES = FAKE_RECORDS - 1 };   /* of a page, beside its mark */

extern const struct fake_flash_kind *kind;

extern struct flash_store store;

extern uint8_t found[CELL_COUNT];

const uint8_t *memory_number(unsigned n);

int start(void);

int save(unsigned n);

void save_many(unsigned count);

void assert_found(unsigned n);

#endif
