/* The last two pages (PM0075 2.3). The core stands still while one is written or erased. */
#include "hal/flash_store/flash.h"

#include "hal/stm32/stm32f103/registers.h"
#include "hal/stm32/line.h"
#include "hal/stm32/machine.h"

enum {
    PAGE_SIZE = 1024,
    ERASE_MS = 100,            /* more than twice what a page takes */
    WRITE_MS = 2,
    SR_BUSY = 1 << 0,
    SR_ERRORS = 1 << 2 | 1 << 4,
    SR_DONE = 1 << 5,
    CR_WRITE = 1 << 0,
    CR_ERASE = 1 << 1,
    CR_START = 1 << 6,
    CR_LOCK = 1 << 7,
    SUPPLY_LOW = 1 << 2         /* in CSR: the supply, compared with what pins.c says */
};

extern volatile uint16_t STORE[FLASH_PAGES][PAGE_SIZE / 2];   /* written by halves of a word */

bool flash_exists(void)
{
    return FLASH.cr & CR_LOCK;   /* set by every reset, and by us whenever we are done */
}

uint32_t flash_page_size(void)
{
    return PAGE_SIZE;
}

uint32_t flash_unit(void)
{
    return 4;   /* two halves of a word, one after the other */
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    const volatile uint16_t *at = &STORE[page][offset / 2];

    for (uint32_t i = 0; i < count / 4; i++)
        words[i] = at[2 * i] | (uint32_t)at[2 * i + 1] << 16;
    return 0;
}

/* 0, or -1: the supply is too low to begin a write or an erase. */
static int unlock(uint32_t setting)
{
    FLASH.keyr = 0x45670123;
    FLASH.keyr = 0xCDEF89ABu;
    FLASH.sr = SR_ERRORS | SR_DONE;
    FLASH.cr = setting;
    return PWR.csr & SUPPLY_LOW ? -1 : 0;
}

/* Waits for what is under way. */
static int wait(uint32_t limit_ms)
{
    uint32_t start = machine_ms();
    uint32_t status;

    do
        status = FLASH.sr;
    while (status & SR_BUSY && machine_ms() - start <= limit_ms);
    line_pump();
    return status & (SR_BUSY | SR_ERRORS) ? -1 : 0;
}

static int lock(int result)
{
    FLASH.cr = CR_LOCK;
    return result;
}

static int write_half(volatile uint16_t *at, uint16_t half)
{
    int result;

    *at = half;
    result = wait(WRITE_MS);
    return result == 0 && *at == half ? 0 : -1;
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    volatile uint16_t *at = &STORE[page][offset / 2];
    int result = unlock(CR_WRITE);

    for (uint32_t i = 0; i < count / 2 && result == 0; i++)
        result = write_half(&at[i], (uint16_t)(words[i / 2] >> 16 * (i % 2)));
    return lock(result);
}

int flash_erase(unsigned page)
{
    if (unlock(CR_ERASE) < 0)
        return lock(-1);
    FLASH.ar = (uint32_t)(uintptr_t)STORE[page];
    FLASH.cr = CR_ERASE | CR_START;
    return lock(wait(ERASE_MS));
}
