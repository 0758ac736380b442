/* What every chip's flash has to do. Built once for each chip, with FLASH_EXPECTED: the header that says what is expected of it. */
#include "tests/test.h"
#include "hal/stm32/chip.h"
#include FLASH_EXPECTED
#include "flash_model.h"

enum { COUNT = 12 };

static const uint32_t WORDS[COUNT] = {0x12345678, 0x9ABCDEF0, 0x0FEDCBA9, 0x87654321, 5, 6, 7, 8, 9, 10, 11, 0xC0FFEE};

void setUp(void)
{
    model_reset();
}

static int write_all(unsigned page, uint32_t offset)
{
    int result = flash_write(page, offset, WORDS, sizeof WORDS);

    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
    return result;
}

static int erase(unsigned page)
{
    int result = flash_erase(page);

    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
    return result;
}

TEST(flash_exists_only_if_its_lock_bit_is_set)
{
    FLASH.cr = ~LOCK;
    TEST_ASSERT_FALSE(flash_exists());
    FLASH.cr = LOCK;
    TEST_ASSERT_TRUE(flash_exists());
}

TEST(page_and_unit_have_the_sizes_of_the_chip)
{
    TEST_ASSERT_EQUAL_UINT32(PAGE_BYTES, flash_page_size());
    TEST_ASSERT_EQUAL_UINT32(UNIT_BYTES, flash_unit());
}

TEST(written_words_read_back_and_others_stay)
{
    uint32_t words[COUNT];
    uint32_t end = PAGE_BYTES - sizeof WORDS;

    TEST_ASSERT_EQUAL(0, write_all(1, end));
    TEST_ASSERT_EQUAL(0, flash_read(1, end, words, sizeof words));
    TEST_ASSERT_EQUAL_HEX32_ARRAY(WORDS, words, COUNT);
    TEST_ASSERT_EQUAL_MEMORY(WORDS, (const char *)STORE + 2 * PAGE_BYTES - sizeof WORDS, sizeof WORDS);
    for (uint32_t at = 0; at < 2u * PAGE_BYTES - sizeof WORDS; at++)
        TEST_ASSERT_EQUAL_HEX8(0xFF, ((const volatile uint8_t *)STORE)[at]);
}

TEST(erase_clears_its_page_only)
{
    for (unsigned page = 0; page < FLASH_PAGES; page++) {
        model_reset();
        memset((void *)STORE, 0, sizeof STORE);
        remember();
        TEST_ASSERT_EQUAL(0, erase(page));
        TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, (const void *)STORE[page], PAGE_BYTES);
        TEST_ASSERT_EACH_EQUAL_HEX8(0, (const void *)STORE[1 - page], PAGE_BYTES);
    }
}

TEST(controller_error_fails_and_ends_the_operation)
{
    for (uint32_t flag = 1; flag <= ERRORS; flag <<= 1) {
        if (!(flag & ERRORS))
            continue;
        model_reset();
        model.fails = flag;
        TEST_ASSERT_EQUAL(-1, write_all(0, 0));
        TEST_ASSERT_EQUAL_UINT(1, model.operations);
        TEST_ASSERT_EQUAL(-1, erase(0));
    }
}

TEST(earlier_error_flags_are_ignored)
{
    model.flags = ERRORS;
    TEST_ASSERT_EQUAL(0, write_all(0, 0));
    model.flags = ERRORS;
    TEST_ASSERT_EQUAL(0, erase(0));
}

TEST(low_supply_refuses_write_and_erase)
{
    supply(true);
    TEST_ASSERT_EQUAL(-1, write_all(0, 0));
    TEST_ASSERT_EQUAL(-1, erase(0));
    TEST_ASSERT_EQUAL_UINT(0, model.operations);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, (const void *)STORE[0], PAGE_BYTES);
}

TEST(operation_waits_only_while_the_flash_is_busy)
{
    uint32_t start = model.now_ms;

    model.busy_ms = 1;
    TEST_ASSERT_EQUAL(0, write_all(0, 0));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(2 * COUNT * WRITES_EACH_WORD, model.now_ms - start);
    start = model.now_ms;
    model.busy_ms = 20;
    TEST_ASSERT_EQUAL(0, erase(0));
    TEST_ASSERT_UINT32_WITHIN(1, 21, model.now_ms - start);
}

TEST(write_times_out_after_its_limit)
{
    model.busy_ms = WRITE_LIMIT_MS;
    TEST_ASSERT_EQUAL(0, write_all(0, 0));
    model_reset();
    model.busy_ms = WRITE_LIMIT_MS + 1;
    TEST_ASSERT_EQUAL(-1, write_all(0, 0));
    TEST_ASSERT_EQUAL_UINT(1, model.operations);
}

TEST(erase_times_out_after_its_limit)
{
    model.busy_ms = ERASE_LIMIT_MS;
    TEST_ASSERT_EQUAL(0, erase(1));
    model_reset();
    model.busy_ms = ERASE_LIMIT_MS + 1;
    TEST_ASSERT_EQUAL(-1, erase(1));
}

/* A cell can lose bits, and a bit can stay as it is. */
TEST(flash_write_stops_at_a_word_that_reads_back_differently)
{
    static const store_word others[] = {0, (store_word)-1};

    for (unsigned i = 0; i < 4; i++) {
        model_reset();
        model.worn = &STORE[0][i / 2];
        model.worn_to = others[i % 2];
        TEST_ASSERT_EQUAL(-1, write_all(0, 0));
        TEST_ASSERT_EQUAL_HEX((store_word)-1, STORE[0][COUNT * WRITES_EACH_WORD - 1]);
    }
}

TEST(pages_have_the_numbers_of_the_chip)
{
    for (unsigned i = 0; i < sizeof NUMBERS / sizeof NUMBERS[0]; i++)
        TEST_ASSERT_EQUAL_UINT32(NUMBERS[i][1], flash_number(NUMBERS[i][0]));
}
