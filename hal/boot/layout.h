/* layout.h: how a chip's flash is divided for updates, in pages as flash.h counts them. Each chip has its own. */
#ifndef OCTET_LAYOUT_H
#define OCTET_LAYOUT_H

#include "hal/boot/choice.h"
#include "hal/flash_store/flash.h"

struct layout {
    const char *chip;             /* such as "stm32f103" */
    const char *board;            /* such as "blue_pill" */
    uint8_t number;               /* of this layout: images for another one do not fit */
    uint16_t choice_page;         /* the first of two */
    uint16_t slot_page[SLOTS];    /* the first of each slot */
    uint16_t slot_pages;          /* of a slot, */
    uint16_t at_once;             /* of which so many are erased together */
};

extern const struct layout LAYOUT;

void boot_start(unsigned slot);
        /* Starts the image in that slot, with the chip as after a reset except for its watchdog. Does not return. */

#endif
