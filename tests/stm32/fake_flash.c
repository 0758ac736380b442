#include "fake_flash.h"

#include <string.h>

#include <unity.h>

struct fake_flash fake_flash;

void fake_flash_clear(void)
{
    memset(&fake_flash, 0, sizeof fake_flash);
    memset(fake_flash.bytes, 0xFF, sizeof fake_flash.bytes);
}

bool flash_exists(void)
{
    return true;
}

uint32_t flash_page_size(void)
{
    return FAKE_PAGE_SIZE;
}

const void *flash_page(unsigned page)
{
    return fake_flash.bytes[page];
}

static bool power_fails_now(void)
{
    return ++fake_flash.operations == fake_flash.cut_at;
}

/* Not begun, half its bits, or all of them. */
static uint8_t half_written(uint8_t old, uint8_t byte)
{
    static const uint8_t kept[] = {0xFF, 0x5A, 0x00};

    return old & (uint8_t)(byte | kept[fake_flash.damage]);
}

static void write_half(uint8_t *at, const uint8_t half[2])
{
    bool cut = power_fails_now();

    TEST_ASSERT_EQUAL_HEX8(0xFF, at[0]);   /* no real flash takes a second write */
    TEST_ASSERT_EQUAL_HEX8(0xFF, at[1]);
    for (unsigned i = 0; i < 2; i++)
        at[i] = cut ? half_written(at[i], half[i]) : half[i];
    if (cut)
        longjmp(fake_flash.cut, 1);
}

int flash_write(unsigned page, uint32_t offset, uint32_t word)
{
    uint8_t *at = &fake_flash.bytes[page][offset];
    uint8_t bytes[4];

    TEST_ASSERT_EQUAL_UINT32(0, offset % 4);
    if (fake_flash.worn[page] >> offset / 16 & 1)
        return -1;
    memcpy(bytes, &word, sizeof bytes);
    write_half(at, bytes);
    write_half(at + 2, bytes + 2);
    return 0;
}

/* Not begun, every other byte, or nearly done: the last byte is still what it was. */
static void half_erase(uint8_t *bytes)
{
    for (unsigned i = 0; i + 1 < FAKE_PAGE_SIZE; i++)
        if (fake_flash.damage == 2 || (fake_flash.damage == 1 && i % 2 == 0))
            bytes[i] = 0xFF;
}

int flash_erase(unsigned page)
{
    if (fake_flash.erase_fails)
        return -1;
    if (fake_flash.erase_does_nothing)
        return 0;
    fake_flash.erases++;
    if (power_fails_now()) {
        half_erase(fake_flash.bytes[page]);
        longjmp(fake_flash.cut, 1);
    }
    memset(fake_flash.bytes[page], 0xFF, FAKE_PAGE_SIZE);
    return 0;
}
