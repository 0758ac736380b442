/* 64 pages of 1 kB: 20 for the boot loader, 20 for each slot, 2 for the choice, 2 for the memory. */
#include "hal/boot/layout.h"

const struct layout LAYOUT = {
    .chip = OCTET_CHIP, .board = OCTET_BOARD, .number = 1,
    .choice_page = FLASH_PAGES + 60,
    .slot_page = {FLASH_PAGES + 20, FLASH_PAGES + 40},
    .slot_pages = 20,
};
