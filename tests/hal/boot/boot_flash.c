#include "boot_flash.h"

#include <string.h>

#include <unity.h>

#include "hal/flash_store/flash.h"

enum { UNIT = 4, STEP = 2, OUTLIVES = 16 };

struct boot_flash boot_flash;

const struct layout LAYOUT = {
    .chip = "stm32test", .board = "test_board", .number = 7,
    .choice_page = CHOICE_PAGE, .slot_page = {SLOT_A, SLOT_B}, .slot_pages = SLOT_PAGES, .at_once = 1,
};

void boot_flash_clear(void)
{
    memset(&boot_flash, 0, sizeof boot_flash);
    memset(boot_flash.bytes, 0xFF, sizeof boot_flash.bytes);
}

uint8_t *boot_flash_slot(unsigned slot)
{
    return boot_flash.bytes[LAYOUT.slot_page[slot]];
}

bool flash_exists(void)
{
    return true;
}

uint32_t flash_page_size(void)
{
    return PAGE;
}

uint32_t flash_unit(void)
{
    return UNIT;
}

static void assert_within(unsigned page, uint32_t offset, uint32_t count)
{
    TEST_ASSERT_TRUE(page >= CHOICE_PAGE && page < PAGES);
    TEST_ASSERT_TRUE(offset % UNIT == 0 && count % UNIT == 0 && offset + count <= PAGE);
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    assert_within(page, offset, count);
    memcpy(words, &boot_flash.bytes[page][offset], count);
    return page == boot_flash.unreadable ? -1 : 0;
}

static bool power_fails_now(void)
{
    return ++boot_flash.operations == boot_flash.cut_at;
}

static void write_step(unsigned page, uint32_t offset, const uint8_t *bytes)
{
    static const uint8_t zeros[STEP];
    uint8_t *at = &boot_flash.bytes[page][offset];
    bool cut = power_fails_now();

    if (memcmp(bytes, zeros, STEP) != 0) {
        TEST_ASSERT_FALSE_MESSAGE(boot_flash.weak[page], "written to a page whose erase was cut short");
        TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, at, STEP);
    }
    for (unsigned i = 0; i < STEP; i++)
        at[i] = cut ? bytes[i] | 0x0F : bytes[i];
    if (cut)
        longjmp(boot_flash.cut, 1);
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    assert_within(page, offset, count);
    if (boot_flash.failing)
        return -1;
    for (uint32_t done = 0; done < count; done += STEP)
        write_step(page, offset + done, (const uint8_t *)words + done);
    return 0;
}

int flash_erase(unsigned page)
{
    assert_within(page, 0, 0);
    if (boot_flash.failing)
        return -1;
    boot_flash.weak[page] = power_fails_now();
    if (boot_flash.weak[page]) {
        memset(&boot_flash.bytes[page][OUTLIVES], 0xFF, PAGE - OUTLIVES);
        longjmp(boot_flash.cut, 1);
    }
    memset(boot_flash.bytes[page], 0xFF, PAGE);
    return 0;
}
