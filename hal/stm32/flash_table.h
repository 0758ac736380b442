/* flash_table.h: what flash.c needs to know of a chip. Notation as in registers.h. */
#ifndef OCTET_FLASH_TABLE_H
#define OCTET_FLASH_TABLE_H

#include "hal/flash_store/flash.h"

struct flash_table {
    volatile uint32_t *keyr, *sr, *cr;
    volatile uint32_t *ar;              /* takes the address of the page to erase; NULL: CR has its number */
    const volatile uint32_t *supply;    /* the supply, compared with what pins.c says */
    uint32_t supply_low;                /* in *supply */
    uint32_t page_size;
    uint32_t unit;
    uint32_t at_once;                   /* bytes that are written at once: a unit, or half of one */
    uint32_t erase_ms;                  /* at least twice what a page takes */
    uint32_t busy, errors, done;        /* SR */
    uint32_t lock, write, erase, start; /* CR */
    uint32_t number_at;                 /* and the lowest bit there of the page's number */
    bool slow;                          /* a unit takes longer than a byte on a serial line */
};

/* In the chip's flash.c, with flash_read. */
extern const struct flash_table FLASH_TABLE;

void flash_begin(unsigned page, uint32_t offset, const uint32_t words[]);
        /* Starts one write of at_once bytes; a half-word is in the low half of words[0]. */

volatile void *flash_place(unsigned page, uint32_t offset);
        /* Where that is. */

uint32_t flash_number(unsigned page);
        /* The chip's own number of a page, for CR. */

bool flash_has(unsigned page, uint32_t offset, const uint32_t words[]);
        /* Whether they read back as written. */

#endif
