#include "flash_store_rig.h"

#include "tests/test.h"
#include "hal/flash_store/crc32.h"
#include "hal/flash_store/flash_store.h"

#include <string.h>

TEST(blank_flash_holds_no_memory)
{
    TEST_ASSERT_EQUAL(0, start());
}

TEST(saved_memory_is_loaded)
{
    save_many(1);
    assert_found(0);
}

TEST(newest_of_many_records_is_loaded)
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

TEST(record_has_its_documented_bytes)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 2};

    save_many(1);
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory, true));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(SECOND_OF_ALL, &fake_flash.bytes[0][2 * 16], sizeof SECOND_OF_ALL);
}

TEST(longer_unit_is_padded_with_ones)
{
    for (kind = KINDS; kind->unit < 32; kind++)
        continue;
    setUp();
    save_many(2);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, &fake_flash.bytes[0][32 + 16], 16);
    TEST_ASSERT_EQUAL_HEX8(2, fake_flash.bytes[0][2 * 32]);
}

TEST(sequence_numbers_wrap)
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

TEST(store_accepts_any_bytes)
{
    static const uint8_t none[CELL_COUNT] = {9, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF};

    save_many(1);
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, none, true));
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(none, found, CELL_COUNT);
}

TEST(unchanged_memory_is_not_written_again)
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

TEST(earlier_memory_is_written_again)
{
    save_many(3);
    TEST_ASSERT_EQUAL(0, save(1));
    assert_found(1);
}

TEST(change_of_any_byte_is_stored)
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

TEST(corrupted_record_is_written_again)
{
    for (unsigned byte = 0; byte < 16; byte++) {
        setUp();
        save_many(3);
        fake_flash.bytes[0][3 * 16 + byte] ^= 1;
        TEST_ASSERT_EQUAL(0, save(2));
        assert_found(2);
    }
}

TEST(random_flash_content_is_no_memory)
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

/* As firmware without page marks leaves it. */
TEST(page_with_a_record_instead_of_its_mark_is_erased)
{
    memcpy(fake_flash.bytes[1], SECOND_OF_ALL, sizeof SECOND_OF_ALL);
    TEST_ASSERT_EQUAL(1, start());
    for (unsigned n = 0; n < CHANGES; n++)
        TEST_ASSERT_EQUAL(0, save(n));
    memcpy(fake_flash.bytes[0], SECOND_OF_ALL, sizeof SECOND_OF_ALL);
    memset(fake_flash.bytes[0] + fake_flash_place(), 0xFF, FAKE_PAGE_MAX - fake_flash_place());
    fake_flash.erases = 0;
    TEST_ASSERT_EQUAL(0, save(CHANGES));
    TEST_ASSERT_EQUAL_UINT(1, fake_flash.erases);
}

/* Its CRC is right: that of four bytes 0xFF and eight zeros is 0xFFFFFFFF. */
TEST(zeros_after_a_partial_erase_are_no_memory)
{
    FOR_EACH_KIND {
        setUp();
        memset(&fake_flash.bytes[0][4], 0, CELL_COUNT);
        TEST_ASSERT_EQUAL(HAL_E_STORE, start());
    }
}

TEST(store_skips_a_sequence_number_whose_crc_reads_as_blank)
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

TEST(flipped_bit_makes_the_previous_record_count)
{
    for (unsigned bit = 0; bit < 8 * 16; bit++) {
        setUp();
        save_many(2);
        fake_flash.bytes[0][2 * 16 + bit / 8] ^= (uint8_t)(1u << bit % 8);
        assert_found(0);
    }
}

/* The record places of a page: which are in use, how they are padded, and how often the store tries another. */

TEST(record_place_with_only_its_last_word_written_is_skipped)
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

TEST(record_padding_is_ones_whatever_precedes_it)
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

TEST(failed_erase_of_a_blank_page_fails_the_save)
{
    fake_flash.erase_fails = true;
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(0));
    TEST_ASSERT_EQUAL_UINT(0, fake_flash.writes);
}

/* Three in the page, the mark of the other one, and one there. */
TEST(save_tries_four_record_places)
{
    TEST_ASSERT_EQUAL(0, start());
    fake_flash.write_fails = true;
    fake_flash.writes = 0;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(0));
    TEST_ASSERT_EQUAL_UINT(3 + 1 + 1, fake_flash.writes);
}

/* Zeros with the inverted CRC of zeros: firmware without page marks skips it as damaged. */
TEST(page_mark_has_its_documented_bytes)
{
    static const uint8_t mark[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x90, 0x39, 0x2A, 0x84};

    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(mark, fake_flash.bytes[0], sizeof mark);
}

/* The failed tries took the numbers after the wrap, and may read well at the next start. */
TEST(memory_is_rewritten_if_numbers_wrap_in_a_failed_save)
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
TEST(store_keeps_the_memory_in_the_second_page_when_the_first_wears_out)
{
    save_many(2 * CHANGES);
    fake_flash.worn[0] = 0xFF;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * CHANGES - 1);
}

static uint32_t crc_of(const char *text)
{
    return crc32((const uint8_t *)text, strlen(text));
}

/* The check value of CRC-32/ISO-HDLC in the catalogue of parametrised CRC algorithms; zlib's crc32 gives all of these. */
TEST(crc32_matches_published_values)
{
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926, crc_of("123456789"));
    TEST_ASSERT_EQUAL_HEX32(0x00000000, crc_of(""));
    TEST_ASSERT_EQUAL_HEX32(0xE8B7BE43, crc_of("a"));
    TEST_ASSERT_EQUAL_HEX32(0x414FA339, crc_of("The quick brown fox jumps over the lazy dog"));
}

TEST(crc_distinguishes_runs_of_zeros_and_ones)
{
    static const uint8_t zeros[4] = {0, 0, 0, 0}, ones[4] = {0xFF, 0xFF, 0xFF, 0xFF};

    TEST_ASSERT_EQUAL_HEX32(0x2144DF1C, crc32(zeros, sizeof zeros));
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, crc32(ones, sizeof ones));
}

TEST(crc_covers_only_the_given_count_of_bytes)
{
    static const uint8_t bytes[3] = {'a', 'b', 'c'};

    TEST_ASSERT_EQUAL_HEX32(0xE8B7BE43, crc32(bytes, 1));
    TEST_ASSERT_EQUAL_HEX32(0x352441C2, crc32(bytes, 3));
}
