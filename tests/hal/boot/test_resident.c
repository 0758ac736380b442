/* An image that a boot loader started. */
#include <string.h>

#include "hal/boot/handover.h"
#include "hal/boot/server.h"
#include "hal/port/cortex_m/leave.h"
#include "hal/port/cortex_m/loader.h"
#include "hal/port/cortex_m/systick.h"
#include "tests/test.h"

#include "tester.h"

enum { NODE = 4, LONG_MS = 5000 };

static uint32_t now_ms;
static unsigned resets, asks;
static struct frame said;

uint32_t machine_ms(void)
{
    return now_ms;
}

void handover_ask(void)
{
    asks++;
}

void leave_by_reset(void)
{
    TEST_ASSERT_EQUAL_UINT(1, asks);
    resets++;
}

static void begin(struct choice choice)
{
    boot_flash_clear();
    signer_put(0, 5);
    signer_put(1, 6);
    tester_power_on();
    TEST_ASSERT_EQUAL(0, choices_save(&choices, &choice, true));
    now_ms = resets = asks = 0;
    (void)loader_node(NODE);
}

void setUp(void)
{
    begin((struct choice){.installed = 3, .slot = 1, .trial = true, .starts = 1});
}

static bool hears(const uint8_t *bytes, uint8_t len, bool at_rest)
{
    struct frame frame = {.id = loader_id(), .len = len};

    memcpy(frame.data, bytes, len);
    return loader_frame(&frame, at_rest, &said);
}

#define HEARS(at_rest, ...) hears((const uint8_t[]){__VA_ARGS__}, sizeof (const uint8_t[]){__VA_ARGS__}, at_rest)
static void assert_said(const uint8_t *bytes, size_t count)
{
    TEST_ASSERT_EQUAL_HEX8_ARRAY(bytes, said.data, count);
}

#define ASSERT_SAID(...) assert_said((const uint8_t[]){__VA_ARGS__}, sizeof (const uint8_t[]){__VA_ARGS__})

static bool is_on_trial(void)
{
    (void)choices_open(&choices, CHOICE_PAGE);
    return choices.now.trial;
}

TEST(its_number_is_the_one_that_is_stored_or_that_of_the_build)
{
    TEST_ASSERT_EQUAL_HEX16(0x6E0 + NODE, loader_id());
    begin((struct choice){.installed = 3, .node = 9});
    TEST_ASSERT_EQUAL_UINT8(9, loader_node(NODE));
    TEST_ASSERT_EQUAL_HEX16(0x6E9, loader_id());
}

TEST(so_is_the_bit_rate_of_the_bus)
{
    static const char *const rates[] = {"", "125000", "250000", "500000", "1000000"};

    for (uint8_t rate = 0; rate < BITRATES; rate++) {
        begin((struct choice){.installed = 3, .bitrate = rate});
        (void)loader_node(NODE);
        TEST_ASSERT_EQUAL_STRING(rates[rate], loader_link());
    }
}

TEST(it_says_what_runs)
{
    TEST_ASSERT_TRUE(HEARS(true, 3, 0x22, 0xFD, 2));
    TEST_ASSERT_EQUAL_HEX32(0x060 + NODE, said.id);
    ASSERT_SAID(7, 0x62, 0xFD, 2, 0, 0, 0, 6);
    TEST_ASSERT_TRUE(HEARS(true, 3, 0x22, 0xFD, 3));
    ASSERT_SAID(7, 0x62, 0xFD, 3, 1, 1, 0, 0);
    begin((struct choice){.installed = 3, .slot = 1});
    TEST_ASSERT_TRUE(HEARS(true, 3, 0x22, 0xFD, 3));
    ASSERT_SAID(7, 0x62, 0xFD, 3, 1, 0, 0, 0);
}

TEST(a_session_and_a_tester_are_answered)
{
    TEST_ASSERT_TRUE(HEARS(true, 2, 0x10, 1));
    ASSERT_SAID(6, 0x50, 1, 0, 50, 1, 0xF4);
    TEST_ASSERT_TRUE(HEARS(true, 3, 0x22, 0xF1, 0x86));
    ASSERT_SAID(4, 0x62, 0xF1, 0x86, 1);
    TEST_ASSERT_TRUE(HEARS(true, 2, 0x3E, 0));
    ASSERT_SAID(2, 0x7E, 0);
    TEST_ASSERT_FALSE(HEARS(true, 2, 0x3E, 0x80));
    TEST_ASSERT_FALSE(HEARS(true, 2, 0x10, 0x81));
}

/* {length, request}, and the code that it is refused with. */
TEST(what_it_does_not_serve_is_refused_with_its_code)
{
    static const struct {
        uint8_t frame[8], code;
    } wrong[] = {
        {{1, 0x00}, 0x11}, {{2, 0x85, 1}, 0x11}, {{1, 0x3F}, 0x11},
        {{2, 0x11, 1}, 0x7F}, {{2, 0x27, 1}, 0x7F}, {{4, 0x2E, 0xFD, 4, 1}, 0x7F}, {{4, 0x31, 1, 0xFF, 1}, 0x7F},
        {{3, 0x34, 0, 0x44}, 0x7F}, {{2, 0x36, 1}, 0x7F}, {{1, 0x37}, 0x7F},
        {{1, 0x10}, 0x13}, {{2, 0x10, 0}, 0x12}, {{2, 0x10, 3}, 0x12}, {{2, 0x10, 0x83}, 0x12}, {{3, 0x10, 1, 0}, 0x13},
        {{1, 0x3E}, 0x13}, {{2, 0x3E, 1}, 0x12}, {{2, 0x3E, 0x81}, 0x12}, {{3, 0x3E, 0, 0}, 0x13},
        {{2, 0x22, 0xFD}, 0x13}, {{3, 0x22, 0xFD, 0}, 0x31}, {{4, 0x22, 0xFD, 2, 0}, 0x13},
    };

    for (unsigned i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        TEST_ASSERT_TRUE(hears(wrong[i].frame, (uint8_t)(wrong[i].frame[0] + 1), true));
        assert_said((const uint8_t[]){3, 0x7F, wrong[i].frame[1], wrong[i].code}, 4);
    }
}

TEST(what_is_no_single_frame_is_left_out)
{
    TEST_ASSERT_FALSE(HEARS(true, 0, 0x3E, 0));
    TEST_ASSERT_FALSE(HEARS(true, 8, 1, 2, 3, 4, 5, 6, 7));
    TEST_ASSERT_FALSE(HEARS(true, 3, 0x3E, 0));
    TEST_ASSERT_FALSE(HEARS(true, 0x10, 20, 0x3E, 0));
}

TEST(while_it_is_driven_it_does_not_leave)
{
    TEST_ASSERT_TRUE(HEARS(false, 2, 0x10, 2));
    ASSERT_SAID(3, 0x7F, 0x10, 0x22);
    now_ms += 1000;
    loader_alive(false);
    TEST_ASSERT_EQUAL_UINT(0, resets);
}

TEST(at_rest_it_leaves_for_the_boot_loader_once_that_was_said)
{
    TEST_ASSERT_TRUE(HEARS(true, 2, 0x10, 2));
    ASSERT_SAID(3, 0x7F, 0x10, 0x78);
    now_ms += SERVER_LAST_MS - 1;
    loader_alive(true);
    TEST_ASSERT_EQUAL_UINT(0, resets);
    now_ms++;
    loader_alive(true);
    TEST_ASSERT_EQUAL_UINT(1, resets);
}

TEST(with_senses_or_a_tester_it_is_confirmed_after_a_while)
{
    now_ms = LONG_MS - 1;
    loader_alive(false);
    TEST_ASSERT_TRUE(is_on_trial());
    now_ms = LONG_MS;
    loader_alive(true);
    TEST_ASSERT_TRUE(is_on_trial());
    loader_alive(false);
    TEST_ASSERT_FALSE(is_on_trial());
    TEST_ASSERT_EQUAL_UINT32(6, choices.now.floor);
    setUp();
    (void)HEARS(true, 3, 0x22, 0xFD, 2);
    now_ms = LONG_MS;
    loader_alive(true);
    TEST_ASSERT_FALSE(is_on_trial());
}

TEST(it_is_confirmed_once_and_a_flash_that_fails_is_not_worn_out)
{
    unsigned written;

    now_ms = LONG_MS;
    loader_alive(false);
    written = boot_flash.operations;
    loader_alive(false);
    TEST_ASSERT_EQUAL_UINT(written, boot_flash.operations);
    setUp();
    now_ms = LONG_MS;
    boot_flash.failing = true;
    loader_alive(false);
    boot_flash.failing = false;
    loader_alive(false);
    TEST_ASSERT_TRUE(is_on_trial());
}
