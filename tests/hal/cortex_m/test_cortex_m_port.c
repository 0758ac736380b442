/* The Cortex-M port: it passes requests to the chip, the flash store and the crash record. */
#include "hal/can_body/port.h"

#include <string.h>

#include "tests/test.h"
#include "hal/flash_store/flash.h"
#include "hal/flash_store/flash_store.h"
#include "hal/port/cortex_m/core.h"
#include "hal/port/cortex_m/crash.h"
#include "hal/port/cortex_m/mcu.h"
#include "hal/port/cortex_m/systick.h"

enum { NODE = 5 };   /* as it is built for */

volatile struct systick_registers SYSTICK;

static const struct crash CRASH;

static struct {
    uint32_t now_ms;
    enum reset_cause chip_cause;
    bool clock_exact, light, no_flash;
    unsigned feeds;
    int opened, saved;         /* what the store returns */
    unsigned page;             /* where another one begins */
    unsigned opens, saves;
    bool may_erase;
    uint8_t bytes[CELL_COUNT];   /* last saved */
} board;

uint32_t machine_ms(void)
{
    return board.now_ms;
}

bool mcu_clock_is_exact(void)
{
    return board.clock_exact;
}

enum reset_cause mcu_reset_cause(void)
{
    return board.chip_cause;
}

void mcu_feed(void)
{
    board.feeds++;
}

void mcu_light(bool on)
{
    board.light = on;
}

enum reset_cause crash_reset_cause(enum reset_cause cause)
{
    return cause == RESET_SOFTWARE ? RESET_CRASH : cause;
}

const struct crash *crash_last(void)
{
    return &CRASH;
}

bool flash_exists(void)
{
    return !board.no_flash;
}

int flash_store_open(struct flash_store *store, uint8_t memory[CELL_COUNT])
{
    TEST_ASSERT_NOT_NULL(store);
    memory[1] = SIDE_LEFT;
    board.opens++;
    return board.opened;
}

int flash_store_open_at(struct flash_store *store, unsigned first_page, uint8_t bytes[CELL_COUNT])
{
    board.page = first_page;
    return flash_store_open(store, bytes);
}

int flash_store_save(struct flash_store *store, const uint8_t memory[CELL_COUNT], bool may_erase)
{
    TEST_ASSERT_NOT_NULL(store);
    memcpy(board.bytes, memory, sizeof board.bytes);
    board.may_erase = may_erase;
    board.saves++;
    return board.saved;
}

void setUp(void)
{
    memset(&board, 0, sizeof board);
}

TEST(port_opens_with_the_values_of_its_build)
{
    struct port port;

    board.clock_exact = true;
    board.chip_cause = RESET_WATCHDOG;
    TEST_ASSERT_EQUAL(0, port_open(&port, 0, NULL));
    TEST_ASSERT_EQUAL_STRING("", port.link);
    TEST_ASSERT_EQUAL_UINT8(NODE, port.node);
    TEST_ASSERT_EQUAL(RESET_WATCHDOG, port.reset_cause);
    TEST_ASSERT_EQUAL_PTR(&CRASH, port.crash);
    TEST_ASSERT_TRUE(port.clock_exact);
}

TEST(reset_after_a_crash_is_reported_as_crash)
{
    struct port port;

    board.chip_cause = RESET_SOFTWARE;
    TEST_ASSERT_EQUAL(0, port_open(&port, 0, NULL));
    TEST_ASSERT_EQUAL(RESET_CRASH, port.reset_cause);
    TEST_ASSERT_FALSE(port.clock_exact);
}

TEST(led_is_on_until_the_link_is_open)
{
    struct port port;

    (void)port_open(&port, 0, NULL);
    TEST_ASSERT_TRUE(board.light);
    port_ready(&port);
    TEST_ASSERT_FALSE(board.light);
}

static unsigned changes_in_a_second(bool outage)
{
    unsigned changes = 0;

    for (board.now_ms = 1024; board.now_ms < 2 * 1024; board.now_ms++) {
        bool before = board.light;

        port_alive(outage);
        changes += board.light != before;
    }
    return changes;
}

TEST(port_alive_feeds_the_watchdog)
{
    port_alive(false);
    port_alive(true);
    TEST_ASSERT_EQUAL_UINT(2, board.feeds);
}

TEST(led_blinks_at_1_hz_and_at_4_hz_in_an_outage)
{
    (void)changes_in_a_second(false);
    TEST_ASSERT_EQUAL_UINT(2, changes_in_a_second(false));
    (void)changes_in_a_second(true);
    TEST_ASSERT_EQUAL_UINT(8, changes_in_a_second(true));
}

TEST(port_clock_is_the_clock_of_the_machine)
{
    board.now_ms = 0xFFFFFFFE;
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFE, port_clock_ms());
}

TEST(memory_is_loaded_from_flash)
{
    uint8_t memory[CELL_COUNT] = {0};

    board.opened = 1;
    TEST_ASSERT_EQUAL(1, port_load(memory));
    TEST_ASSERT_EQUAL_UINT8(SIDE_LEFT, memory[1]);
    board.opened = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_E_STORE, port_load(memory));
}

TEST(memory_store_may_erase_flash_only_at_rest)
{
    const uint8_t memory[CELL_COUNT] = {0, SIDE_LEFT, SIDE_RIGHT};

    TEST_ASSERT_EQUAL(0, port_store(memory, PORT_AT_REST));
    TEST_ASSERT_TRUE(board.may_erase);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(memory, board.bytes, CELL_COUNT);
    board.saved = FLASH_STORE_LATER;
    TEST_ASSERT_EQUAL(PORT_LATER, port_store(memory, PORT_QUICKLY));
    TEST_ASSERT_FALSE(board.may_erase);
    board.saved = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_E_STORE, port_store(memory, PORT_QUICKLY));
}

TEST(body_records_have_flash_pages_of_their_own)
{
    uint8_t bytes[CELL_COUNT] = {0, SIDE_RIGHT};

    board.opened = 1;
    TEST_ASSERT_EQUAL(1, port_load_more(0, bytes));
    TEST_ASSERT_EQUAL_UINT(FLASH_PAGES + 58, board.page);
    TEST_ASSERT_EQUAL(1, port_load_more(1, bytes));
    TEST_ASSERT_EQUAL_UINT(FLASH_PAGES + 60, board.page);
    TEST_ASSERT_EQUAL_UINT8(SIDE_LEFT, bytes[1]);
    TEST_ASSERT_EQUAL(0, port_store_more(1, bytes));
    TEST_ASSERT_TRUE(board.may_erase);
    board.saved = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_E_STORE, port_store_more(1, bytes));
}

TEST(load_and_store_succeed_without_a_flash)
{
    uint8_t memory[CELL_COUNT] = {0};

    board.no_flash = true;
    board.opened = board.saved = HAL_E_STORE;
    TEST_ASSERT_EQUAL(0, port_load(memory));
    TEST_ASSERT_EQUAL(0, port_store(memory, PORT_AT_REST));
    TEST_ASSERT_EQUAL(0, port_load_more(1, memory));
    TEST_ASSERT_EQUAL(0, port_store_more(1, memory));
    TEST_ASSERT_EQUAL_UINT(0, board.opens + board.saves);
}

/* A linear congruential generator that starts from the contents of RAM and adds the timer's value: known answers from 0. */
TEST(entropy_mixes_in_the_timer_value)
{
    SYSTICK.val = 0;
    TEST_ASSERT_EQUAL_HEX32(0x3C6EF35F, port_entropy());
    TEST_ASSERT_EQUAL_HEX32(0x47502932, port_entropy());
    SYSTICK.val = 7;
    TEST_ASSERT_EQUAL_HEX32(0xD27EC144, port_entropy());
}
