/* Pages 62 and 63 (RM0440 5.3). The core stands still while one is written or erased.
 *
 * Eight bytes are written at once, with eight bits to correct an error in them. A write that a loss of power cut short can leave
 * eight bytes that no correction fits: reading them causes a non-maskable interrupt. */
#include "hal/flash_store/flash.h"

#include "hal/stm32/machine.h"
#include "hal/stm32/stm32g431/flash_errors.h"
#include "hal/stm32/stm32g431/registers.h"

enum {
    PAGE_SIZE = 2048,
    UNIT = 8,
    FIRST_PAGE = 62,
    ERASE_MS = 100,            /* four times what a page takes */
    WRITE_MS = 2,
    INTERRUPT_MAX = 100,       /* looks at a flag until its interrupt has come, which is a matter of cycles */
    SR_DONE = 1 << 0,
    SR_ERRORS = 0xC3FA,
    SR_BUSY = 1 << 16,
    CR_WRITE = 1 << 0,
    CR_ERASE = 1 << 1,
    CR_PAGE_AT = 3,
    CR_START = 1 << 16,
    SUPPLY_LOW = 1 << 11         /* in SR2: the supply, compared with what pins.c says */
};

static const uint32_t CR_LOCK = 1u << 31, ECCR_TWO_BITS = 1u << 31;

extern volatile uint32_t STORE[FLASH_PAGES][PAGE_SIZE / 4];

static volatile bool reading, unreadable;

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
    return UNIT;
}

__attribute__((used)) bool flash_forgives(void)   /* by nmi.c, in lines that the linker cannot read */
{
    if (!reading || !(FLASH.eccr & ECCR_TWO_BITS))
        return false;
    FLASH.eccr = ECCR_TWO_BITS;
    unreadable = true;
    return true;
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    unreadable = false;
    reading = true;
    for (uint32_t i = 0; i < count / 4; i++)
        words[i] = STORE[page][offset / 4 + i];
    for (unsigned i = 0; i < INTERRUPT_MAX && FLASH.eccr & ECCR_TWO_BITS; i++)
        continue;
    reading = false;
    return unreadable || FLASH.eccr & ECCR_TWO_BITS ? -1 : 0;
}

/* 0, or -1: the supply is too low to begin a write or an erase. */
static int unlock(uint32_t setting)
{
    FLASH.keyr = 0x45670123;
    FLASH.keyr = 0xCDEF89ABu;
    FLASH.sr = SR_ERRORS | SR_DONE;
    FLASH.cr = setting;
    return PWR.sr2 & SUPPLY_LOW ? -1 : 0;
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

/* The second word starts it. */
static int write_unit(volatile uint32_t at[2], const uint32_t words[2])
{
    at[0] = words[0];
    at[1] = words[1];
    return wait(WRITE_MS);
}

static bool reads_back(unsigned page, uint32_t offset, const uint32_t words[2])
{
    uint32_t found[2];

    return flash_read(page, offset, found, UNIT) == 0 && found[0] == words[0] && found[1] == words[1];
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    int result = unlock(CR_WRITE);

    for (uint32_t done = 0; done < count && result == 0; done += UNIT) {
        result = write_unit(&STORE[page][(offset + done) / 4], &words[done / 4]);
        if (result == 0 && !reads_back(page, offset + done, &words[done / 4]))
            result = -1;
    }
    return lock(result);
}

int flash_erase(unsigned page)
{
    uint32_t setting = CR_ERASE | (FIRST_PAGE + page) << CR_PAGE_AT;

    if (unlock(setting) < 0)
        return lock(-1);
    FLASH.cr = setting | CR_START;
    return lock(wait(ERASE_MS));
}
