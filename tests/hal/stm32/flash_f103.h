/* flash_f103.h: what test_flash.c expects of an STM32F103 (PM0075 3). */
#ifndef OCTET_FLASH_F103_H
#define OCTET_FLASH_F103_H

#include "hal/stm32/stm32f103/registers.h"

enum {
    PAGE_BYTES = 1024, STORE_WORDS = PAGE_BYTES / 2, UNIT_BYTES = 4, WRITES_EACH_WORD = 2,
    BUSY = 1, ONE_ERROR = 1 << 4, ERRORS = 1 << 2 | 1 << 4, DONE = 1 << 5,
    WRITING = 1, ERASING = 1 << 1, START = 1 << 6,
    WRITE_LIMIT_MS = 2, ERASE_LIMIT_MS = 100
};

typedef uint16_t store_word;

static const uint32_t LOCK = 1u << 7;

volatile struct flash_registers FLASH;
volatile struct power_registers PWR;
volatile store_word STORE[FLASH_PAGES][STORE_WORDS];
volatile store_word PAGES[1][STORE_WORDS];   /* of the whole chip */
static const unsigned NUMBERS[][2] = {{0, 0}, {FLASH_PAGES, 0}};   /* the address of a page tells it */

static void supply(bool low)
{
    PWR.csr = low ? 1u << 2 : ~(1u << 2);
}

static int page_asked_for(void)
{
    for (int page = 0; page < FLASH_PAGES; page++)
        if (FLASH.cr == (ERASING | START) && FLASH.ar == (uint32_t)(uintptr_t)STORE[page])
            return page;
    return -1;
}

#endif
