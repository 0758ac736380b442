/* What only this chip's flash does: it writes half a word at a time, and its core stands still meanwhile. */
#include <string.h>

#include "hal/flash_store/flash.h"
#include "hal/port/cortex_m/uart.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/stm32f103/registers.h"
#include "tests/test.h"

enum { HALVES = 512, LOCK = 1 << 7 };

volatile struct flash_registers FLASH;
volatile struct power_registers PWR;
volatile uint16_t STORE[FLASH_PAGES][HALVES];
volatile uint16_t PAGES[3][HALVES];

static struct {
    unsigned count;
    uint16_t halves[2][2];   /* of the word, each time */
} pumped;

/* Each operation is done when the driver reads the clock. */
uint32_t machine_ms(void)
{
    FLASH.sr = 0;
    return 0;
}

void line_pump(void)
{
    if (pumped.count < 2) {
        pumped.halves[pumped.count][0] = STORE[1][10];
        pumped.halves[pumped.count][1] = STORE[1][11];
    }
    pumped.count++;
}

void setUp(void)
{
    memset((void *)&FLASH, 0, sizeof FLASH);
    memset((void *)STORE, 0xFF, sizeof STORE);
    memset(&pumped, 0, sizeof pumped);
    FLASH.cr = LOCK;
}

TEST(word_is_written_in_halves_with_line_pump_after_each)
{
    static const uint16_t lower_first[2][2] = {{0x5678, 0xFFFF}, {0x5678, 0x1234}};
    const uint32_t word = 0x12345678;

    TEST_ASSERT_EQUAL(0, flash_write(1, 20, &word, sizeof word));
    TEST_ASSERT_EQUAL_UINT(2, pumped.count);
    TEST_ASSERT_EQUAL_MEMORY(lower_first, pumped.halves, sizeof lower_first);
}

TEST(flash_erase_serves_the_serial_line)
{
    TEST_ASSERT_EQUAL(0, flash_erase(1));
    TEST_ASSERT_EQUAL_UINT(1, pumped.count);
}

TEST(pages_after_the_store_address_the_whole_chip)
{
    uint32_t word = 0x12345678, read;

    memset((void *)PAGES, 0xFF, sizeof PAGES);
    TEST_ASSERT_EQUAL(0, flash_write(FLASH_PAGES + 1, 8, &word, sizeof word));
    TEST_ASSERT_EQUAL(0, flash_read(FLASH_PAGES + 1, 8, &read, sizeof read));
    TEST_ASSERT_EQUAL_HEX32(word, read);
    TEST_ASSERT_EQUAL_HEX16(0x5678, PAGES[1][4]);
    TEST_ASSERT_EQUAL(0, flash_erase(FLASH_PAGES + 2));
    TEST_ASSERT_EQUAL_HEX32((uint32_t)(uintptr_t)PAGES[2], FLASH.ar);
}
