/* flash_g431.h: what test_flash.c expects of an STM32G431 (RM0440 5). */
#ifndef OCTET_FLASH_G431_H
#define OCTET_FLASH_G431_H

#include "hal/stm32/stm32g431/registers.h"

enum {
    PAGE_BYTES = 2048, STORE_WORDS = PAGE_BYTES / 4, UNIT_BYTES = 8, WRITES_EACH_WORD = 1,
    BUSY = 1 << 16, ONE_ERROR = 1 << 3, ERRORS = 0xC3FA, DONE = 1,
    WRITING = 1, ERASING = 2, START = 1 << 16, FIRST_PAGE = 62,
    WRITE_LIMIT_MS = 2, ERASE_LIMIT_MS = 100
};

typedef uint32_t store_word;

static const uint32_t LOCK = 1u << 31;

volatile struct flash_registers FLASH;
volatile struct power_registers PWR;
volatile store_word STORE[FLASH_PAGES][STORE_WORDS];
volatile store_word PAGES[1][STORE_WORDS];   /* of the whole chip */
static const unsigned NUMBERS[][2] = {{0, 62}, {1, 63}, {FLASH_PAGES, 0}, {FLASH_PAGES + 10, 10}};

static void supply(bool low)
{
    PWR.sr2 = low ? 1u << 11 : ~(1u << 11);
}

static int page_asked_for(void)
{
    return (FLASH.cr & ~(127u << 3)) == (ERASING | START) ? (int)(FLASH.cr >> 3 & 127u) - FIRST_PAGE : -1;
}

#endif
