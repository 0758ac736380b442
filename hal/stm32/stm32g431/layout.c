/* 64 pages of 2 kB: 10 for the boot loader, 24 for each slot, 2 of no use, 2 for the choice, 2 for the memory. */
#include "hal/boot/layout.h"

const struct layout LAYOUT = {
    .chip = OCTET_CHIP, .board = OCTET_BOARD, .number = 1,
    .choice_page = FLASH_PAGES + 60,
    .slot_page = {FLASH_PAGES + 10, FLASH_PAGES + 34},
    .slot_pages = 24,
    .at_once = 1,
};
