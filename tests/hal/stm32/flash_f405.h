/* flash_f405.h: what test_flash.c expects of an STM32F405 (RM0090 3). */
#ifndef OCTET_FLASH_F405_H
#define OCTET_FLASH_F405_H

#include "hal/stm32/stm32f405/registers.h"

enum {
    PAGE_BYTES = 16384, STORE_WORDS = PAGE_BYTES / 4, UNIT_BYTES = 4, WRITES_EACH_WORD = 1,
    BUSY = 1 << 16, ONE_ERROR = 1 << 4, ERRORS = 0xF2, DONE = 1,
    BY_32_BITS = 2 << 8, WRITING = BY_32_BITS | 1, ERASING = BY_32_BITS | 2, START = 1 << 16, FIRST_SECTOR = 1,
    WRITE_LIMIT_MS = 2, ERASE_LIMIT_MS = 1000
};

typedef uint32_t store_word;

static const uint32_t LOCK = 1u << 31;

volatile struct flash_registers FLASH;
volatile struct power_registers PWR;
volatile store_word STORE[FLASH_PAGES][STORE_WORDS];
static const unsigned NUMBERS[][2] = {{0, 1}, {1, 2}};

static void supply(bool low)
{
    PWR.csr = low ? 1u << 2 : ~(1u << 2);
}

static int page_asked_for(void)
{
    return (FLASH.cr & ~(15u << 3)) == (ERASING | START) ? (int)(FLASH.cr >> 3 & 15u) - FIRST_SECTOR : -1;
}

#endif
