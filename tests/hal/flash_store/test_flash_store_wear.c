/* When the flash store erases a page, and what it does about places that are worn. */
#include "hal/flash_store/flash_store.h"

#include <string.h>

#include "tests/test.h"
#include "fake_flash.h"

#include "flash_store_rig.h"

TEST(a_page_is_erased_once_for_a_page_of_records)
{
    save_many(10 * CHANGES);
    TEST_ASSERT_EQUAL_UINT(10, fake_flash.erases);
}

TEST(without_leave_nothing_is_erased)
{
    save_many(2 * CHANGES);
    fake_flash.erases = 0;
    TEST_ASSERT_EQUAL(FLASH_STORE_LATER, flash_store_save(&store, memory_number(99), false));
    TEST_ASSERT_EQUAL_UINT(0, fake_flash.erases);
    assert_found(2 * CHANGES - 1);
}

TEST(what_was_put_off_is_saved_with_leave)
{
    save_many(2 * CHANGES);
    (void)flash_store_save(&store, memory_number(99), false);
    TEST_ASSERT_EQUAL(0, save(99));
    assert_found(99);
}

/* A start finds time for it. */
TEST(without_leave_there_is_room_again_after_a_start)
{
    save_many(2 * CHANGES);
    assert_found(2 * CHANGES - 1);
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory_number(99), false));
    assert_found(99);
}

TEST(a_new_chip_has_room_from_the_start_and_is_erased_once)
{
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory_number(7), false));
    TEST_ASSERT_EQUAL_UINT(1, fake_flash.erases);
    assert_found(7);
}

TEST(starts_alone_do_not_wear_a_flash_whose_page_is_full)
{
    save_many(3 * CHANGES);
    for (unsigned i = 0; i < 10; i++)
        assert_found(3 * CHANGES - 1);
    TEST_ASSERT_EQUAL_UINT(4, fake_flash.erases);
}

TEST(an_erase_that_fails_leaves_the_old_memory)
{
    save_many(2 * CHANGES);
    fake_flash.erase_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * CHANGES - 1);
}

TEST(an_erase_that_erases_nothing_leaves_the_old_memory)
{
    save_many(2 * CHANGES);
    fake_flash.erase_does_nothing = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * CHANGES - 1);
}

TEST(after_a_start_the_page_in_use_is_filled_first)
{
    save_many(CHANGES + 1);
    fake_flash.erases = 0;
    assert_found(CHANGES);
    TEST_ASSERT_EQUAL(0, save(99));
    TEST_ASSERT_EQUAL_UINT(0, fake_flash.erases);
}

TEST(rubbish_in_either_page_is_no_blank_flash)
{
    for (unsigned page = 0; page < FLASH_PAGES; page++) {
        setUp();
        fake_flash.bytes[page][5] = 0;
        TEST_ASSERT_EQUAL(HAL_E_STORE, start());
    }
}

TEST(worn_records_are_passed_over)
{
    fake_flash.worn[0] = 2;
    save_many(2);
    assert_found(1);
}

TEST(a_mark_that_cannot_be_written_is_done_without)
{
    fake_flash.worn[0] = 1;
    save_many(2);
    assert_found(1);
    TEST_ASSERT_EQUAL(0, save(2));
    TEST_ASSERT_EQUAL_UINT(1, fake_flash.erases);
    assert_found(2);
}

static void save_in_vain(unsigned n)
{
    fake_flash.write_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(n));
    fake_flash.write_fails = false;
}

TEST(what_seemed_to_fail_never_wins_over_what_was_saved_next)
{
    FOR_EACH_KIND
        for (unsigned before = 1; before < 3 * CHANGES; before++) {
            setUp();
            save_many(before);
            save_in_vain(100);
            TEST_ASSERT_EQUAL(0, save(101));
            assert_found(101);
        }
}

TEST(what_seemed_to_fail_never_wins_over_the_old_memory_saved_again)
{
    for (unsigned before = 1; before < 3 * CHANGES; before++) {
        setUp();
        save_many(before);
        save_in_vain(100);
        TEST_ASSERT_EQUAL(0, save(before - 1));
        assert_found(before - 1);
    }
}

/* A record that did not read well when its successor was saved reads well at the next start. */
TEST(a_record_that_recovers_never_wins_over_a_later_one)
{
    uint8_t good[16];

    for (unsigned byte = 0; byte < 16; byte++) {
        setUp();
        save_many(2);
        memcpy(good, &fake_flash.bytes[0][2 * 16], sizeof good);
        fake_flash.bytes[0][2 * 16 + byte] ^= 1;
        assert_found(0);
        TEST_ASSERT_EQUAL(0, save(50));
        memcpy(&fake_flash.bytes[0][2 * 16], good, sizeof good);
        assert_found(50);
    }
}

TEST(a_page_worn_all_over_never_costs_the_memory_in_the_other)
{
    save_many(CHANGES);
    fake_flash.worn[1] = 0xFF;
    for (unsigned tries = 0; tries < 5; tries++)
        TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(CHANGES - 1);
}

TEST(a_store_in_other_pages_turns_its_own)
{
    struct flash_store other;

    FOR_EACH_KIND {
        setUp();
        save_many(1);
        (void)flash_store_open_at(&other, FLASH_PAGES, found);
        for (unsigned n = 1; n <= 3 * CHANGES; n++)
            TEST_ASSERT_EQUAL(0, flash_store_save(&other, memory_number(n), true));
        TEST_ASSERT_EQUAL(1, flash_store_open_at(&other, FLASH_PAGES, found));
        TEST_ASSERT_EQUAL_UINT8_ARRAY(memory_number(3 * CHANGES), found, CELL_COUNT);
        assert_found(0);
    }
}
