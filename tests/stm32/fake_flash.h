/* fake_flash.h: two small pages of flash in RAM, whose power fails on plan. */
#ifndef OCTET_FAKE_FLASH_H
#define OCTET_FAKE_FLASH_H

#include <setjmp.h>
#include <stdint.h>

#include "hal/flash_store/flash.h"

enum {
    FAKE_RECORDS = 4,                      /* of a page */
    FAKE_PAGE_SIZE = 16 * FAKE_RECORDS
};

struct fake_flash {
    uint8_t bytes[FLASH_PAGES][FAKE_PAGE_SIZE];
    unsigned operations;        /* so far: each half-word written, each page erased */
    unsigned cut_at;            /* power fails within this one, counted from 1; 0: never */
    unsigned damage;            /* how far it gets then: three kinds, 0..2 */
    jmp_buf cut;                /* and control goes here */
    unsigned erases;
    bool erase_fails;
    bool erase_does_nothing;    /* and says that it did */
    uint8_t worn[FLASH_PAGES];  /* bit r: record r of the page takes no writes */
};

extern struct fake_flash fake_flash;

void fake_flash_clear(void);
        /* All erased, nothing fails. */

#endif
