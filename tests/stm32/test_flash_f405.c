/* The flash's registers in RAM: the controller looks at them whenever the driver asks for the time. */
#include <string.h>

#include <unity.h>

#include "hal/flash_store/flash.h"
#include "hal/stm32/stm32f405/registers.h"
#include "hal/stm32/machine.h"

enum { WORDS = 4096, BUSY = 1 << 16, PROTECTED = 1 << 4, START = 1 << 16, FOREVER = 1 << 30 };

static const uint32_t LOCK = 1u << 31;

volatile struct flash_registers FLASH;
volatile uint32_t STORE[FLASH_PAGES][WORDS];

static struct {
    uint32_t now_ms, busy_ms, error;
    uint32_t setting;      /* of FLASH.cr while it works */
    volatile uint32_t *worn;   /* does not keep what is written */
} controller;

uint32_t machine_ms(void)
{
    if (!(FLASH.cr & LOCK))
        controller.setting = FLASH.cr;
    if (FLASH.cr & START && controller.busy_ms == 0 && controller.error == 0)
        memset((void *)STORE[(FLASH.cr >> 3 & 15) - 1], 0xFF, sizeof STORE[0]);
    if (controller.worn)
        *controller.worn = 0;
    FLASH.sr = controller.error | (controller.now_ms < controller.busy_ms ? BUSY : 0u);
    return controller.now_ms++;
}

void setUp(void)
{
    memset((void *)&FLASH, 0, sizeof FLASH);
    memset((void *)STORE, 0xFF, sizeof STORE);
    memset(&controller, 0, sizeof controller);
    FLASH.cr = LOCK;
}

void tearDown(void) {}

static void test_a_controller_that_is_locked_after_reset_is_one(void)
{
    TEST_ASSERT_TRUE(flash_exists());
    FLASH.cr = 0;
    TEST_ASSERT_FALSE(flash_exists());
}

static void test_pages_are_16_kb_written_by_words(void)
{
    TEST_ASSERT_EQUAL_UINT32(16384, flash_page_size());
    TEST_ASSERT_EQUAL_UINT32(4, flash_unit());
}

static void test_it_reads_what_lies_there(void)
{
    uint32_t words[2];

    STORE[1][5] = 0x12345678;
    TEST_ASSERT_EQUAL(0, flash_read(1, 20, words, sizeof words));
    TEST_ASSERT_EQUAL_HEX32(0x12345678, words[0]);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, words[1]);
}

static int write_one(unsigned page, uint32_t offset, uint32_t word)
{
    return flash_write(page, offset, &word, sizeof word);
}

static void test_words_are_written_where_they_belong_four_bytes_at_once(void)
{
    static const uint32_t words[] = {0x12345678, 0x9ABCDEF0};

    TEST_ASSERT_EQUAL(0, flash_write(1, 20, words, sizeof words));
    TEST_ASSERT_EQUAL_HEX32(0x12345678, STORE[1][5]);
    TEST_ASSERT_EQUAL_HEX32(0x9ABCDEF0, STORE[1][6]);
    TEST_ASSERT_EQUAL_HEX32(0x201, controller.setting);
}

static void test_the_keys_come_in_their_order_and_it_is_locked_again(void)
{
    (void)write_one(0, 0, 1);
    TEST_ASSERT_EQUAL_HEX32(0xCDEF89AB, FLASH.keyr);   /* the second of two */
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
}

static void test_a_write_that_is_refused_fails(void)
{
    controller.error = PROTECTED;
    TEST_ASSERT_EQUAL(-1, write_one(0, 0, 1));
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
}

static void test_what_does_not_read_back_fails_and_ends_the_write(void)
{
    static const uint32_t words[] = {1, 2};

    controller.worn = &STORE[1][5];
    TEST_ASSERT_EQUAL(-1, flash_write(1, 20, words, sizeof words));
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, STORE[1][6]);
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
}

static void test_a_write_that_never_ends_is_given_up(void)
{
    controller.busy_ms = FOREVER;
    TEST_ASSERT_EQUAL(-1, write_one(0, 0, 1));
    TEST_ASSERT_LESS_THAN_UINT32(10, controller.now_ms);
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
}

static void test_each_page_is_a_sector_and_erased_by_itself(void)
{
    for (unsigned page = 0; page < FLASH_PAGES; page++) {
        memset((void *)STORE, 0, sizeof STORE);
        TEST_ASSERT_EQUAL(0, flash_erase(page));
        TEST_ASSERT_EQUAL_HEX32(START | 0x202 | (page + 1) << 3, controller.setting);
        TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, STORE[page][WORDS - 1]);
        TEST_ASSERT_EQUAL_HEX32(0, STORE[1 - page][0]);
    }
}

static void test_an_erase_may_take_most_of_a_second_and_no_more(void)
{
    controller.busy_ms = 800;
    TEST_ASSERT_EQUAL(0, flash_erase(0));
    controller.now_ms = 0;
    controller.busy_ms = FOREVER;
    TEST_ASSERT_EQUAL(-1, flash_erase(0));
    TEST_ASSERT_LESS_THAN_UINT32(1100, controller.now_ms);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_controller_that_is_locked_after_reset_is_one);
    RUN_TEST(test_pages_are_16_kb_written_by_words);
    RUN_TEST(test_it_reads_what_lies_there);
    RUN_TEST(test_words_are_written_where_they_belong_four_bytes_at_once);
    RUN_TEST(test_the_keys_come_in_their_order_and_it_is_locked_again);
    RUN_TEST(test_a_write_that_is_refused_fails);
    RUN_TEST(test_what_does_not_read_back_fails_and_ends_the_write);
    RUN_TEST(test_a_write_that_never_ends_is_given_up);
    RUN_TEST(test_each_page_is_a_sector_and_erased_by_itself);
    RUN_TEST(test_an_erase_may_take_most_of_a_second_and_no_more);
    return UNITY_END();
}
