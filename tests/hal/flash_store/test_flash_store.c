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

TEST(the_layout_is_what_it_always_was)
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

TEST(what_the_bytes_mean_is_the_robots_business)
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

TEST(one_flipped_bit_makes_the_record_before_it_count)
{
    for (unsigned bit = 0; bit < 8 * 16; bit++) {
        setUp();
        save_many(2);
        fake_flash.bytes[0][2 * 16 + bit / 8] ^= (uint8_t)(1u << bit % 8);
        assert_found(0);
    }
}
