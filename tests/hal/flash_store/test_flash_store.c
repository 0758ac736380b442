#include "hal/flash_store/flash_store.h"

#include <string.h>

#include "tests/test.h"
#include "fake_flash.h"

#include "flash_store_rig.h"

TEST(a_blank_flash_holds_no_memory)
{
    TEST_ASSERT_EQUAL(0, start());
}

TEST(what_was_saved_is_found)
{
    save_many(1);
    assert_found(0);
}

TEST(the_newest_of_many_is_found)
{
    FOR_EACH_KIND
        for (unsigned count = 1; count <= 5 * CHANGES; count++) {
            setUp();
            save_many(count);
            assert_found(count - 1);
        }
}

static const uint8_t SECOND_OF_ALL[] = {0x02, 0x00, 0x00, 0x00, 0x00, 0x01, 0x02, 0x01, 0x02, 0x01, 0x02, 0x02, 0xED, 0x7A, 0xC2, 0x36};
static const uint8_t LAST_OF_ALL[] = {0xFF, 0xFF, 0xFF, 0xFF, 0x00, 0x01, 0x02, 0x01, 0x02, 0x01, 0x02, 0x02, 0xE2, 0xDD, 0xD3, 0x5E};

TEST(the_record_layout_has_not_changed)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 2};

    save_many(1);
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory, true));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(SECOND_OF_ALL, &fake_flash.bytes[0][2 * 16], sizeof SECOND_OF_ALL);
}

TEST(a_longer_unit_is_filled_up)
{
    for (kind = KINDS; kind->unit < 32; kind++)
        continue;
    setUp();
    save_many(2);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, &fake_flash.bytes[0][32 + 16], 16);
    TEST_ASSERT_EQUAL_HEX8(2, fake_flash.bytes[0][2 * 32]);
}

TEST(numbers_wrap)
{
    FOR_EACH_KIND {
        setUp();
        memcpy(fake_flash.bytes[0], LAST_OF_ALL, sizeof LAST_OF_ALL);
        TEST_ASSERT_EQUAL(1, start());
        for (unsigned n = 0; n < 3 * CHANGES; n++) {
            TEST_ASSERT_EQUAL(0, save(n));
            assert_found(n);
        }
    }
}

TEST(the_store_accepts_any_bytes)
{
    static const uint8_t none[CELL_COUNT] = {9, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

    save_many(1);
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, none, true));
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(none, found, CELL_COUNT);
}

TEST(what_is_stored_already_is_not_written_again)
{
    FOR_EACH_KIND {
        setUp();
        save_many(2);
        fake_flash.writes = fake_flash.erases = 0;
        for (unsigned i = 0; i < 10 * CHANGES; i++)
            TEST_ASSERT_EQUAL(0, save(1));
        assert_found(1);
        TEST_ASSERT_EQUAL(0, save(1));
        TEST_ASSERT_EQUAL_UINT(0, fake_flash.writes + fake_flash.erases);
    }
}

TEST(what_was_stored_earlier_is_written_again)
{
    save_many(3);
    TEST_ASSERT_EQUAL(0, save(1));
    assert_found(1);
}

TEST(a_change_of_any_one_byte_is_stored)
{
    uint8_t memory[CELL_COUNT] = {0};

    save_many(1);
    for (unsigned p = 0; p < CELL_COUNT; p++) {
        memory[p] ^= 2;
        TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory, true));
        TEST_ASSERT_EQUAL(1, start());
        TEST_ASSERT_EQUAL_HEX8_ARRAY(memory, found, CELL_COUNT);
    }
}

TEST(what_does_not_read_back_any_more_is_written_again)
{
    for (unsigned byte = 0; byte < 16; byte++) {
        setUp();
        save_many(3);
        fake_flash.bytes[0][3 * 16 + byte] ^= 1;
        TEST_ASSERT_EQUAL(0, save(2));
        assert_found(2);
    }
}

TEST(random_bytes_are_no_memory_and_the_robot_starts)
{
    memset(fake_flash.bytes, 0x3C, sizeof fake_flash.bytes);
    TEST_ASSERT_EQUAL(HAL_E_STORE, start());
    TEST_ASSERT_EQUAL(0, save(5));
    assert_found(5);
}

TEST(pages_of_zeros_hold_no_memory)
{
    memset(fake_flash.bytes, 0, sizeof fake_flash.bytes);
    TEST_ASSERT_EQUAL(HAL_E_STORE, start());
}

/* Its CRC is right: that of four bytes 0xFF and eight zeros is 0xFFFFFFFF. */
TEST(zeros_behind_the_beginning_of_an_erase_are_no_memory)
{
    FOR_EACH_KIND {
        setUp();
        memset(&fake_flash.bytes[0][4], 0, CELL_COUNT);
        TEST_ASSERT_EQUAL(HAL_E_STORE, start());
    }
}

TEST(a_number_whose_crc_looks_like_none_is_left_out)
{
    static const uint8_t before[] = {0xFE, 0xFF, 0xFF, 0xFF, 0x00, 0x01, 0x02, 0x01, 0x02, 0x01, 0x02, 0x02, 0x8D, 0x91, 0x76, 0xC5};
    static const uint8_t zeros[CELL_COUNT];

    memcpy(fake_flash.bytes[0], before, sizeof before);
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, zeros, true));
    TEST_ASSERT_EQUAL_HEX8(0, fake_flash.bytes[0][fake_flash_place()]);
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(zeros, found, CELL_COUNT);
}

TEST(one_flipped_bit_makes_the_record_before_it_count)
{
    for (unsigned bit = 0; bit < 8 * 16; bit++) {
        setUp();
        save_many(2);
        fake_flash.bytes[0][2 * 16 + bit / 8] ^= (uint8_t)(1u << bit % 8);
        assert_found(0);
    }
}

/* The places of a page: what is in use, what fills them, and how often the store tries another. */

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
TEST(the_mark_has_not_changed)
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
