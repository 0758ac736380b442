/* 64 pages of 1 kB: 16 for the boot loader, 22 for each slot, 2 for the choice, 2 for the memory. */
#include "hal/boot/layout.h"

const struct layout LAYOUT = {
    .chip = OCTET_CHIP, .board = OCTET_BOARD, .number = 2,
    .choice_page = FLASH_PAGES + 60,
    .slot_page = {FLASH_PAGES + 16, FLASH_PAGES + 38},
    .slot_pages = 22,
    .at_once = 1,
};
