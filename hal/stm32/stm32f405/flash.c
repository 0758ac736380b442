/* Sectors 1 and 2 (RM0090 3.6). The core stands still while one is written or erased. */
#include "hal/flash_store/flash.h"

#include "hal/stm32/stm32f405/registers.h"
#include "hal/stm32/machine.h"

enum {
    SECTOR_SIZE = 16384,
    FIRST_SECTOR = 1,
    ERASE_MS = 1000,           /* more than the slowest sector of 16 kB takes */
    WRITE_MS = 2,
    SR_DONE = 1 << 0,
    SR_ERRORS = 0xF2,
    SR_BUSY = 1 << 16,
    CR_WRITE = 1 << 0,
    CR_ERASE = 1 << 1,
    CR_SECTOR_AT = 3,
    CR_WORDS = 2 << 8,         /* four bytes at once, for 2.7 V and more */
    CR_START = 1 << 16,
    SUPPLY_LOW = 1 << 2         /* in CSR: the supply, compared with what pins.c says */
};

static const uint32_t CR_LOCK = 1u << 31;

extern volatile uint32_t STORE[FLASH_PAGES][SECTOR_SIZE / 4];

bool flash_exists(void)
{
    return FLASH.cr & CR_LOCK;   /* set by every reset, and by us whenever we are done */
}

uint32_t flash_page_size(void)
{
    return SECTOR_SIZE;
}

uint32_t flash_unit(void)
{
    return 4;
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    for (uint32_t i = 0; i < count / 4; i++)
        words[i] = STORE[page][offset / 4 + i];
    return 0;
}

/* 0, or -1: the supply is too low to begin a write or an erase. */
static int unlock(uint32_t setting)
{
    FLASH.keyr = 0x45670123;
    FLASH.keyr = 0xCDEF89ABu;
    FLASH.sr = SR_ERRORS | SR_DONE;
    FLASH.cr = CR_WORDS | setting;
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
    return status & (SR_BUSY | SR_ERRORS) ? -1 : 0;
}

static int lock(int result)
{
    FLASH.cr = CR_LOCK;
    return result;
}

static int write_word(volatile uint32_t *at, uint32_t word)
{
    int result;

    *at = word;
    result = wait(WRITE_MS);
    return result == 0 && *at == word ? 0 : -1;
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    volatile uint32_t *at = &STORE[page][offset / 4];
    int result = unlock(CR_WRITE);

    for (uint32_t i = 0; i < count / 4 && result == 0; i++)
        result = write_word(&at[i], words[i]);
    return lock(result);
}

int flash_erase(unsigned page)
{
    uint32_t setting = CR_ERASE | (FIRST_SECTOR + page) << CR_SECTOR_AT;

    if (unlock(setting) < 0)
        return lock(-1);
    FLASH.cr = CR_WORDS | setting | CR_START;
    return lock(wait(ERASE_MS));
}
