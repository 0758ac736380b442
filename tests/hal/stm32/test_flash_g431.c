/* What only this chip's flash does: it tells of what its error correction cannot read, by an interrupt. */
#define _DEFAULT_SOURCE   /* mprotect */
#include <signal.h>
#include <string.h>
#include <sys/mman.h>

#include "hal/flash_store/flash.h"
#include "hal/port/cortex_m/uart.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/stm32g431/registers.h"
#include "tests/test.h"

enum { HOST_PAGE = 4096, WORDS = 512 };

static const uint32_t LOCK = 1u << 31, TWO_BITS = 1u << 31;

bool flash_forgives(void);   /* called by assembly */

volatile struct flash_registers FLASH;
volatile struct power_registers PWR;
__attribute__((aligned(HOST_PAGE))) volatile uint32_t STORE[FLASH_PAGES][WORDS];
volatile uint32_t PAGES[1][WORDS];

/* Each operation is done when the driver reads the clock. */
uint32_t machine_ms(void)
{
    FLASH.sr = 0;
    return 0;
}

void line_pump(void)
{
}

void setUp(void)
{
    memset((void *)&FLASH, 0, sizeof FLASH);
    memset((void *)STORE, 0xFF, sizeof STORE);
    FLASH.cr = LOCK;
}

TEST(uncorrectable_ecc_error_fails_read_and_write)
{
    uint32_t words[2] = {1, 2};

    FLASH.eccr = TWO_BITS;
    TEST_ASSERT_EQUAL(-1, flash_write(0, 0, words, sizeof words));
    TEST_ASSERT_EQUAL_HEX32(LOCK, FLASH.cr);
    TEST_ASSERT_EQUAL(-1, flash_read(0, 0, words, sizeof words));
    FLASH.eccr = 0;
    TEST_ASSERT_EQUAL(0, flash_read(0, 0, words, sizeof words));
    TEST_ASSERT_EQUAL(0, flash_write(0, 8, words, sizeof words));
}

TEST(pages_after_the_store_address_the_whole_chip)
{
    static const uint32_t words[2] = {0x12345678, 0x9ABCDEF0};
    uint32_t read[2];

    memset((void *)PAGES, 0xFF, sizeof PAGES);
    TEST_ASSERT_EQUAL(0, flash_write(FLASH_PAGES, 8, words, sizeof words));
    TEST_ASSERT_EQUAL(0, flash_read(FLASH_PAGES, 8, read, sizeof read));
    TEST_ASSERT_EQUAL_HEX32_ARRAY(words, read, 2);
    TEST_ASSERT_EQUAL_HEX32(words[1], PAGES[0][3]);
}

TEST(ecc_interrupt_outside_of_a_read_is_not_handled)
{
    FLASH.eccr = TWO_BITS;
    TEST_ASSERT_FALSE(flash_forgives());
}

TEST(flash_read_ignores_the_address_of_an_earlier_error)
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

TEST(ecc_interrupt_in_a_read_fails_that_read_once)
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
