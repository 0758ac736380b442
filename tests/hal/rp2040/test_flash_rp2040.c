/* The store's flash, with fake ROM functions on the test's memory. */
#include "hal/flash_store/flash.h"

#include <string.h>

#include "tests/test.h"
#include "hal/port/cortex_m/uart.h"
#include "hal/rp2040/machine.h"

enum { SECTORS_AT = 0x1C0000, SECTOR_COUNT = 64, NEVER = -1 };

uint32_t SECTORS[SECTOR_COUNT * ROM_SECTOR / 4];
static uint8_t *const bytes = (uint8_t *)SECTORS;

static bool exists;
static int stuck;                 /* a byte that does not change */
static unsigned pumped;
static uint32_t last;             /* offset of the last operation */
static const uint32_t words[8] = {0x11111111, 0x22222222, 0x33333333, 0x44444444, 5, 6, 7, 8};

bool rom_exists(void)
{
    return exists;
}

void rom_erase(uint32_t offset)
{
    last = offset;
    for (int i = 0; i < ROM_SECTOR; i++)
        if (i != stuck)
            bytes[offset - SECTORS_AT + (uint32_t)i] = 0xFF;
}

void rom_write(uint32_t offset, const uint32_t page[ROM_PAGE / 4])
{
    TEST_ASSERT_EQUAL_UINT32(0, offset % ROM_PAGE);
    last = offset;
    for (int i = 0; i < ROM_PAGE; i++)
        if (i != stuck)
            bytes[offset - SECTORS_AT + (uint32_t)i] &= ((const uint8_t *)page)[i];
}

void line_pump(void)
{
    pumped++;
}

void setUp(void)
{
    memset(SECTORS, 0xFF, sizeof SECTORS);
    exists = true;
    stuck = NEVER;
    pumped = 0;
}

static void assert_reads(unsigned page, uint32_t offset, const uint32_t expected[], uint32_t count)
{
    uint32_t found[8];

    TEST_ASSERT_EQUAL(0, flash_read(page, offset, found, count));
    TEST_ASSERT_EQUAL_HEX32_ARRAY(expected, found, count / 4);
}

TEST(flash_exists_if_the_rom_has_its_functions)
{
    TEST_ASSERT_TRUE(flash_exists());
    exists = false;
    TEST_ASSERT_FALSE(flash_exists());
}

TEST(unit_is_16_bytes_and_page_is_4_kib)
{
    TEST_ASSERT_EQUAL_UINT32(16, flash_unit());
    TEST_ASSERT_EQUAL_UINT32(4096, flash_page_size());
}

TEST(store_is_at_the_end_of_the_flash)
{
    TEST_ASSERT_EQUAL(0, flash_erase(0));
    TEST_ASSERT_EQUAL_HEX32(0x1FE000, last);
    TEST_ASSERT_EQUAL(0, flash_erase(1));
    TEST_ASSERT_EQUAL_HEX32(0x1FF000, last);
}

TEST(body_stores_are_before_the_memory_store)
{
    TEST_ASSERT_EQUAL(0, flash_erase(FLASH_PAGES + 58));
    TEST_ASSERT_EQUAL_HEX32(0x1FA000, last);
    TEST_ASSERT_EQUAL(0, flash_erase(FLASH_PAGES + 61));
    TEST_ASSERT_EQUAL_HEX32(0x1FD000, last);
}

TEST(written_words_read_back_and_others_stay)
{
    static const uint32_t blank[2] = {UINT32_MAX, UINT32_MAX};

    TEST_ASSERT_EQUAL(0, flash_write(1, 0x4F0, words, 32));   /* over the end of a page of the flash */
    assert_reads(1, 0x4F0, words, 32);
    assert_reads(1, 0x4E8, blank, 8);
    assert_reads(1, 0x510, blank, 8);
    assert_reads(0, 0x4F0, blank, 8);
}

TEST(zeros_can_be_written_over_any_word)
{
    static const uint32_t zeros[4];

    TEST_ASSERT_EQUAL(0, flash_write(0, 16, words, 16));
    TEST_ASSERT_EQUAL(0, flash_write(0, 16, zeros, 16));
    assert_reads(0, 16, zeros, 16);
}

TEST(erase_clears_its_sector_only)
{
    TEST_ASSERT_EQUAL(0, flash_write(0, 0, words, 16));
    TEST_ASSERT_EQUAL(0, flash_write(1, 0, words, 16));
    TEST_ASSERT_EQUAL(0, flash_erase(0));
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, &bytes[62 * ROM_SECTOR], ROM_SECTOR);
    assert_reads(1, 0, words, 16);
}

TEST(flash_write_fails_at_a_byte_that_keeps_its_value)
{
    stuck = 35;
    TEST_ASSERT_EQUAL(0, flash_write(0, 0, words, 16));
    TEST_ASSERT_EQUAL(-1, flash_write(0, 32, words, 32));
    TEST_ASSERT_EQUAL_HEX8(0xFF, bytes[62 * ROM_SECTOR + 48]);   /* nothing after it is tried */
    bytes[62 * ROM_SECTOR + 35] = 0;
    TEST_ASSERT_EQUAL(-1, flash_erase(0));
}

TEST(serial_line_is_served_after_each_operation)
{
    (void)flash_write(0, 0, words, 32);
    TEST_ASSERT_EQUAL(2, pumped);
    (void)flash_erase(0);
    TEST_ASSERT_EQUAL(3, pumped);
}
