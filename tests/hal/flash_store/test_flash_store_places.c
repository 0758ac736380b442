/* The places of a page: what is in use, what fills them, and how often the store tries another. */
#include "hal/flash_store/flash_store.h"

#include <string.h>

#include "tests/test.h"
#include "fake_flash.h"

#include "flash_store_rig.h"

TEST(a_place_whose_last_word_alone_is_written_is_in_use)
{
    FOR_EACH_KIND {
        uint8_t *last_word;

        setUp();
        save_many(1);
        last_word = &fake_flash.bytes[0][2 * fake_flash_place() + 12];
        *last_word = 0;
        TEST_ASSERT_EQUAL(1, start());
        TEST_ASSERT_EQUAL(0, save(1));
        TEST_ASSERT_EQUAL_HEX8(0xFF, last_word[-1]);
        assert_found(1);
    }
}

TEST(whatever_fills_the_last_place_the_next_one_is_filled_with_ones)
{
    for (kind = KINDS; kind->unit < 32; kind++)
        continue;
    setUp();
    save_many(1);
    memset(&fake_flash.bytes[0][32 + 16], 0, 16);
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL(0, save(1));
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, &fake_flash.bytes[0][2 * 32 + 16], 16);
}

TEST(an_erase_that_fails_on_a_blank_page_is_a_failure_too)
{
    fake_flash.erase_fails = true;
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(0));
    TEST_ASSERT_EQUAL_UINT(0, fake_flash.writes);
}

/* Three in the page, the mark of the other one, and one there. */
TEST(a_save_is_tried_four_times)
{
    TEST_ASSERT_EQUAL(0, start());
    fake_flash.write_fails = true;
    fake_flash.writes = 0;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(0));
    TEST_ASSERT_EQUAL_UINT(3 + 1 + 1, fake_flash.writes);
}

/* Firmware that knows no marks passes it over: zeros, with the CRC of zeros inverted. */
TEST(the_mark_is_what_it_always_was)
{
    static const uint8_t mark[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x90, 0x39, 0x2A, 0x84};

    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(mark, fake_flash.bytes[0], sizeof mark);
}

/* The tries took the numbers after the wrap, and may read well at the next start. */
TEST(what_was_stored_is_written_again_when_numbers_wrapped_in_a_failed_save)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 2};
    static const uint8_t last_of_all[] = {0xFF, 0xFF, 0xFF, 0xFF, 0, 1, 2, 1, 2, 1, 2, 2, 0xE2, 0xDD, 0xD3, 0x5E};

    memcpy(fake_flash.bytes[0], last_of_all, sizeof last_of_all);
    TEST_ASSERT_EQUAL(1, start());
    fake_flash.write_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(100));
    fake_flash.write_fails = false;
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory, true));
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(memory, found, CELL_COUNT);
}

/* The newest record is in page 1, and has come there since the start. */
TEST(a_first_page_that_wears_out_never_costs_the_memory_in_the_second)
{
    save_many(2 * CHANGES);
    fake_flash.worn[0] = 0xFF;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * CHANGES - 1);
}
