/* As test_flash_f405.c. */
#include <string.h>

#include <unity.h>

#include "hal/flash_store/flash.h"
#include "hal/stm32/stm32f103/registers.h"
#include "hal/stm32/line.h"
#include "hal/stm32/machine.h"

enum { HALVES = 512, BUSY = 1, NOT_ERASED = 1 << 2, LOCK = 1 << 7, FOREVER = 1 << 30 };

volatile struct flash_registers FLASH;
volatile uint16_t STORE[FLASH_PAGES][HALVES];

static struct {
    uint32_t now_ms, busy_ms, error;
    unsigned operations, failing;   /* the n-th fails, counted from 1 */
    unsigned pumped;
    volatile uint16_t *worn;        /* does not keep what is written */
} controller;

uint32_t machine_ms(void)
{
    controller.operations += controller.now_ms == 0;
    if (controller.worn)
        *controller.worn = 0;
    FLASH.sr = controller.now_ms < controller.busy_ms ? BUSY : 0u;
    if (controller.error != 0 && controller.operations == controller.failing)
        FLASH.sr |= controller.error;
    return controller.now_ms++;
}

/* Each operation ends with this. */
void line_pump(void)
{
    controller.pumped++;
    controller.now_ms = 0;
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

static void test_pages_are_1_kb_written_by_words(void)
{
    TEST_ASSERT_EQUAL_UINT32(1024, flash_page_size());
    TEST_ASSERT_EQUAL_UINT32(4, flash_unit());
}

static void test_it_reads_what_lies_there(void)
{
    uint32_t words[2];

    STORE[1][10] = 0x5678;
    TEST_ASSERT_EQUAL(0, flash_read(1, 20, words, sizeof words));
    TEST_ASSERT_EQUAL_HEX32(0xFFFF5678, words[0]);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, words[1]);
}

static int write_one(unsigned page, uint32_t offset, uint32_t word)
{
    return flash_write(page, offset, &word, sizeof word);
}

static void test_a_word_is_written_in_halves_the_lower_first_in_place(void)
{
    TEST_ASSERT_EQUAL(0, write_one(1, 20, 0x12345678));
    TEST_ASSERT_EQUAL_HEX16(0x5678, STORE[1][10]);
    TEST_ASSERT_EQUAL_HEX16(0x1234, STORE[1][11]);
    TEST_ASSERT_EQUAL_UINT(2, controller.operations);
}

static void test_words_follow_each_other(void)
{
    static const uint32_t words[] = {0x12345678, 0x9ABCDEF0};

    TEST_ASSERT_EQUAL(0, flash_write(0, 8, words, sizeof words));
    TEST_ASSERT_EQUAL_HEX16(0x1234, STORE[0][5]);
    TEST_ASSERT_EQUAL_HEX16(0xDEF0, STORE[0][6]);
    TEST_ASSERT_EQUAL_HEX16(0x9ABC, STORE[0][7]);
}

static void test_the_line_is_pumped_after_each_half(void)
{
    (void)write_one(0, 0, 1);
    TEST_ASSERT_EQUAL_UINT(2, controller.pumped);
}

static void test_the_keys_come_in_their_order_and_it_is_locked_again(void)
{
    (void)write_one(0, 0, 1);
    TEST_ASSERT_EQUAL_HEX32(0xCDEF89AB, FLASH.keyr);   /* the second of two */
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
}

static void test_either_half_that_is_refused_fails(void)
{
    for (unsigned n = 1; n <= 2; n++) {
        setUp();
        controller.error = NOT_ERASED;
        controller.failing = n;
        TEST_ASSERT_EQUAL(-1, write_one(0, 0, 1));
        TEST_ASSERT_EQUAL_UINT(n, controller.operations);
        TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
    }
}

static void test_what_does_not_read_back_fails_and_ends_the_write(void)
{
    controller.worn = &STORE[1][10];
    TEST_ASSERT_EQUAL(-1, write_one(1, 20, 0x12345678));
    TEST_ASSERT_EQUAL_HEX16(0xFFFF, STORE[1][11]);
}

static void test_a_write_that_never_ends_is_given_up(void)
{
    controller.busy_ms = FOREVER;
    TEST_ASSERT_EQUAL(-1, write_one(0, 0, 1));
    TEST_ASSERT_EQUAL_UINT(1, controller.operations);
}

static void test_a_page_is_erased_by_its_address(void)
{
    TEST_ASSERT_EQUAL(0, flash_erase(1));
    TEST_ASSERT_EQUAL_HEX32((uint32_t)(uintptr_t)STORE[1], FLASH.ar);
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
}

static void test_an_erase_that_never_ends_is_given_up(void)
{
    controller.busy_ms = FOREVER;
    TEST_ASSERT_EQUAL(-1, flash_erase(0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_controller_that_is_locked_after_reset_is_one);
    RUN_TEST(test_pages_are_1_kb_written_by_words);
    RUN_TEST(test_it_reads_what_lies_there);
    RUN_TEST(test_words_follow_each_other);
    RUN_TEST(test_a_word_is_written_in_halves_the_lower_first_in_place);
    RUN_TEST(test_the_line_is_pumped_after_each_half);
    RUN_TEST(test_the_keys_come_in_their_order_and_it_is_locked_again);
    RUN_TEST(test_either_half_that_is_refused_fails);
    RUN_TEST(test_what_does_not_read_back_fails_and_ends_the_write);
    RUN_TEST(test_a_write_that_never_ends_is_given_up);
    RUN_TEST(test_a_page_is_erased_by_its_address);
    RUN_TEST(test_an_erase_that_never_ends_is_given_up);
    return UNITY_END();
}
