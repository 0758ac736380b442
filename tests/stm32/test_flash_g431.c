/* As test_flash_f405.c. */
#define _DEFAULT_SOURCE   /* mprotect */
#include <signal.h>
#include <string.h>
#include <sys/mman.h>

#include <unity.h>

#include "hal/flash_store/flash.h"
#include "hal/stm32/machine.h"
#include "hal/stm32/stm32g431/flash_errors.h"
#include "hal/stm32/stm32g431/registers.h"

enum { HOST_PAGE = 4096, WORDS = 512, BUSY = 1 << 16, NOT_ERASED = 1 << 3, START = 1 << 16, FOREVER = 1 << 30, FIRST_PAGE = 62 };

static const uint32_t LOCK = 1u << 31, TWO_BITS = 1u << 31;

volatile struct flash_registers FLASH;
__attribute__((aligned(HOST_PAGE))) volatile uint32_t STORE[FLASH_PAGES][WORDS];

static struct {
    uint32_t now_ms, busy_ms, error;
    uint32_t setting;           /* of FLASH.cr while it works */
    unsigned operations;
    volatile uint32_t *spoils;  /* a word that does not come out as written */
} controller;

uint32_t machine_ms(void)
{
    if (!(FLASH.cr & LOCK))
        controller.setting = FLASH.cr;
    if (FLASH.cr & START && controller.busy_ms == 0 && controller.error == 0)
        memset((void *)STORE[(FLASH.cr >> 3 & 127) - FIRST_PAGE], 0xFF, sizeof STORE[0]);
    if (controller.spoils)
        *controller.spoils ^= 1u;
    controller.spoils = NULL;
    controller.operations += controller.now_ms == 0;
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

static const uint32_t FOUR[] = {0x12345678, 0x9ABCDEF0, 0x0FEDCBA9, 0x87654321};

static int write_four(unsigned page, uint32_t offset)
{
    return flash_write(page, offset, FOUR, sizeof FOUR);
}

static void test_a_controller_that_is_locked_after_reset_is_one(void)
{
    TEST_ASSERT_TRUE(flash_exists());
    FLASH.cr = 0;
    TEST_ASSERT_FALSE(flash_exists());
}

static void test_pages_are_2_kb_written_by_8_bytes(void)
{
    TEST_ASSERT_EQUAL_UINT32(2048, flash_page_size());
    TEST_ASSERT_EQUAL_UINT32(8, flash_unit());
}

static void test_units_are_written_where_they_belong(void)
{
    TEST_ASSERT_EQUAL(0, write_four(1, 16));
    for (unsigned i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_HEX32(FOUR[i], STORE[1][4 + i]);
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, STORE[1][3] & STORE[1][8]);
    TEST_ASSERT_EQUAL_HEX32(1, controller.setting);
}

static void test_it_reads_what_lies_there(void)
{
    uint32_t words[4];

    (void)write_four(0, 8);
    TEST_ASSERT_EQUAL(0, flash_read(0, 8, words, sizeof words));
    TEST_ASSERT_EQUAL_HEX32_ARRAY(FOUR, words, 4);
}

static void test_the_keys_come_in_their_order_and_it_is_locked_again(void)
{
    (void)write_four(0, 0);
    TEST_ASSERT_EQUAL_HEX32(0xCDEF89AB, FLASH.keyr);   /* the second of two */
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
}

static void test_a_write_that_is_refused_fails_and_goes_no_further(void)
{
    controller.error = NOT_ERASED;
    TEST_ASSERT_EQUAL(-1, write_four(0, 0));
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, STORE[0][2]);
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
}

static void test_a_write_that_does_not_read_back_fails(void)
{
    for (unsigned word = 0; word < 2; word++) {
        setUp();
        controller.spoils = &STORE[0][word];
        TEST_ASSERT_EQUAL(-1, write_four(0, 0));
        TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
    }
}

static void test_a_write_that_never_ends_is_given_up(void)
{
    controller.busy_ms = FOREVER;
    TEST_ASSERT_EQUAL(-1, write_four(0, 0));
    TEST_ASSERT_LESS_THAN_UINT32(10, controller.now_ms);
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
}

static void test_each_page_is_erased_by_its_number(void)
{
    for (unsigned page = 0; page < FLASH_PAGES; page++) {
        memset((void *)STORE, 0, sizeof STORE);
        TEST_ASSERT_EQUAL(0, flash_erase(page));
        TEST_ASSERT_EQUAL_HEX32(START | 2 | (FIRST_PAGE + page) << 3, controller.setting);
        TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, STORE[page][WORDS - 1]);
        TEST_ASSERT_EQUAL_HEX32(0, STORE[1 - page][0]);
        TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
    }
}

static void test_an_erase_that_never_ends_is_given_up(void)
{
    controller.busy_ms = FOREVER;
    TEST_ASSERT_EQUAL(-1, flash_erase(0));
    TEST_ASSERT_LESS_THAN_UINT32(200, controller.now_ms);
}

/* ---- what no error correction can read */

static void test_what_cannot_be_corrected_cannot_be_read(void)
{
    uint32_t words[2];

    FLASH.eccr = TWO_BITS;
    TEST_ASSERT_EQUAL(-1, flash_read(0, 0, words, sizeof words));
    TEST_ASSERT_EQUAL(-1, write_four(0, 0));
    FLASH.eccr = 0;
    TEST_ASSERT_EQUAL(0, flash_read(0, 0, words, sizeof words));
}

static void test_an_interrupt_is_forgiven_to_nobody_but_the_reader(void)
{
    FLASH.eccr = TWO_BITS;
    TEST_ASSERT_FALSE(flash_forgives());
}

static void test_an_address_that_an_old_error_has_left_is_no_error(void)
{
    uint32_t words[2];

    FLASH.eccr = ~TWO_BITS;
    TEST_ASSERT_EQUAL(0, flash_read(0, 0, words, sizeof words));
}

/* The host's own trap stands for the interrupt: it comes when the word is read, and the reading goes on after it. */
static volatile sig_atomic_t forgiven, interrupts;

static void interrupt(int number)
{
    (void)number;
    interrupts++;
    FLASH.eccr = TWO_BITS | 0x1234;
    forgiven = flash_forgives();
    if (FLASH.eccr == TWO_BITS)
        FLASH.eccr = 0x1234;   /* as written: the flag goes, and the address stays */
    (void)mprotect((void *)STORE, sizeof STORE, PROT_READ | PROT_WRITE);
}

static void test_an_interrupt_while_reading_is_forgiven_and_told_once(void)
{
    struct sigaction handler = {.sa_handler = interrupt}, before;
    uint32_t words[2];
    int result;

    (void)sigaction(SIGSEGV, &handler, &before);
    (void)mprotect((void *)STORE, sizeof STORE, PROT_NONE);
    result = flash_read(0, 0, words, sizeof words);
    (void)sigaction(SIGSEGV, &before, NULL);
    TEST_ASSERT_EQUAL(-1, result);
    TEST_ASSERT_EQUAL(1, interrupts);
    TEST_ASSERT_TRUE(forgiven);
    TEST_ASSERT_EQUAL(0, flash_read(0, 0, words, sizeof words));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_controller_that_is_locked_after_reset_is_one);
    RUN_TEST(test_pages_are_2_kb_written_by_8_bytes);
    RUN_TEST(test_units_are_written_where_they_belong);
    RUN_TEST(test_it_reads_what_lies_there);
    RUN_TEST(test_the_keys_come_in_their_order_and_it_is_locked_again);
    RUN_TEST(test_a_write_that_is_refused_fails_and_goes_no_further);
    RUN_TEST(test_a_write_that_does_not_read_back_fails);
    RUN_TEST(test_a_write_that_never_ends_is_given_up);
    RUN_TEST(test_each_page_is_erased_by_its_number);
    RUN_TEST(test_an_erase_that_never_ends_is_given_up);
    RUN_TEST(test_what_cannot_be_corrected_cannot_be_read);
    RUN_TEST(test_an_interrupt_is_forgiven_to_nobody_but_the_reader);
    RUN_TEST(test_an_address_that_an_old_error_has_left_is_no_error);
    RUN_TEST(test_an_interrupt_while_reading_is_forgiven_and_told_once);
    return UNITY_END();
}
