/* Flash access common to all chips. The core stalls during a write or an erase. */
#include "hal/port/cortex_m/uart.h"
#include "hal/stm32/chip.h"

enum { WRITE_MS = 2 };

static const struct flash_table *const chip = &FLASH_TABLE;

bool flash_exists(void)
{
    return *chip->cr & chip->lock;   /* set by every reset, and by us after each operation */
}

uint32_t flash_page_size(void)
{
    return chip->page_size;
}

uint32_t flash_unit(void)
{
    return chip->unit;
}

/* Returns 0, or -1 if the supply is too low for a write or an erase. */
static int unlock(uint32_t setting)
{
    *chip->keyr = 0x45670123;
    *chip->keyr = 0xCDEF89ABu;
    *chip->sr = chip->errors | chip->done;
    *chip->cr = setting;
    return *chip->supply & chip->supply_low ? -1 : 0;
}

/* Waits for the current operation. */
static int wait(uint32_t limit_ms)
{
    uint32_t start = machine_ms();
    uint32_t status;

    do
        status = *chip->sr;
    while (status & chip->busy && machine_ms() - start <= limit_ms);
    if (chip->slow)
        line_pump();
    return status & (chip->busy | chip->errors) ? -1 : 0;
}

static int lock(int result)
{
    *chip->cr = chip->lock;
    return result;
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    int result = unlock(chip->write);

    for (uint32_t done = 0; done < count && result == 0; done += chip->at_once) {
        const uint32_t piece[] = {words[done / 4] >> 8 * (done % 4), chip->at_once > 4 ? words[done / 4 + 1] : 0};

        flash_begin(page, offset + done, piece);
        result = wait(WRITE_MS);
        if (result == 0 && !flash_has(page, offset + done, piece))
            result = -1;
    }
    return lock(result);
}

int flash_erase(unsigned page)
{
    uint32_t setting = chip->erase | flash_number(page) << chip->number_at;

    if (unlock(setting) < 0)
        return lock(-1);
    if (chip->ar)
        *chip->ar = (uint32_t)(uintptr_t)flash_place(page, 0);
    *chip->cr = setting | chip->start;
    return lock(wait(chip->erase_ms));
}
