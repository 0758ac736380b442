/* Pages of 16 kB: sector 0 for the boot loader, 1 and 2 for memory, 3 and 4 for the choice, 5 and 6 for the slots. */
#include "hal/boot/layout.h"

const struct layout LAYOUT = {
    .chip = OCTET_CHIP, .board = OCTET_BOARD, .number = 1,
    .choice_page = FLASH_PAGES + 3,
    .slot_page = {FLASH_PAGES + 8, FLASH_PAGES + 16},
    .slot_pages = 8,
    .at_once = 8,
};
