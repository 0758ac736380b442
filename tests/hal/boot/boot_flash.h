/* boot_flash.h: a small chip in RAM, its flash like that of an STM32F103: choice, two slots, and a power that fails on plan. */
#ifndef OCTET_BOOT_FLASH_H
#define OCTET_BOOT_FLASH_H

#include <setjmp.h>
#include <stdint.h>

#include "hal/boot/layout.h"

enum {
    PAGE = 256, SLOT_PAGES = 5, SLOT_BYTES = PAGE * SLOT_PAGES,
    CHOICE_PAGE = 2, SLOT_A = 4, SLOT_B = SLOT_A + SLOT_PAGES, PAGES = SLOT_B + SLOT_PAGES
};

struct boot_flash {
    uint8_t bytes[PAGES][PAGE];
    bool weak[PAGES];        /* its erase was cut short: nobody may write there, but zeros */
    unsigned operations;     /* erases, and half-words written */
    unsigned cut_at;         /* the power fails within this one, counted from 1; 0: never */
    jmp_buf cut;             /* and control goes here */
    bool failing;            /* nothing can be written or erased */
    unsigned unreadable;     /* page that cannot be read; 0: none */
};

extern struct boot_flash boot_flash;

void boot_flash_clear(void);
        /* All blank. */

uint8_t *boot_flash_slot(unsigned slot);

#endif
