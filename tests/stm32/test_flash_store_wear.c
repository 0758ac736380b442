/* When the flash store erases a page, and what it does about places that are worn. */
#include "hal/flash_store/flash_store.h"

#include <string.h>

#include <unity.h>

#include "fake_flash.h"

#include "flash_store_rig.h"

static void test_a_page_is_erased_once_for_a_page_of_records(void)
{
    save_many(10 * CHANGES);
    TEST_ASSERT_EQUAL_UINT(10, fake_flash.erases);
}

static void test_without_leave_nothing_is_erased(void)
{
    save_many(2 * CHANGES);
    fake_flash.erases = 0;
    TEST_ASSERT_EQUAL(FLASH_STORE_LATER, flash_store_save(&store, memory_number(99), false));
    TEST_ASSERT_EQUAL_UINT(0, fake_flash.erases);
    assert_found(2 * CHANGES - 1);
}

static void test_what_was_put_off_is_saved_with_leave(void)
{
    save_many(2 * CHANGES);
    (void)flash_store_save(&store, memory_number(99), false);
    TEST_ASSERT_EQUAL(0, save(99));
    assert_found(99);
}

/* A start finds time for it. */
static void test_without_leave_there_is_room_again_after_a_start(void)
{
    save_many(2 * CHANGES);
    assert_found(2 * CHANGES - 1);
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory_number(99), false));
    assert_found(99);
}

static void test_a_new_chip_has_room_from_the_start_and_is_erased_once(void)
{
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory_number(7), false));
    TEST_ASSERT_EQUAL_UINT(1, fake_flash.erases);
    assert_found(7);
}

static void test_starts_alone_do_not_wear_a_flash_whose_page_is_full(void)
{
    save_many(3 * CHANGES);
    for (unsigned i = 0; i < 10; i++)
        assert_found(3 * CHANGES - 1);
    TEST_ASSERT_EQUAL_UINT(4, fake_flash.erases);
}

static void test_an_erase_that_fails_leaves_the_old_memory(void)
{
    save_many(2 * CHANGES);
    fake_flash.erase_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * CHANGES - 1);
}

static void test_an_erase_that_erases_nothing_leaves_the_old_memory(void)
{
    save_many(2 * CHANGES);
    fake_flash.erase_does_nothing = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * CHANGES - 1);
}

static void test_after_a_start_the_page_in_use_is_filled_first(void)
{
    save_many(CHANGES + 1);
    fake_flash.erases = 0;
    assert_found(CHANGES);
    TEST_ASSERT_EQUAL(0, save(99));
    TEST_ASSERT_EQUAL_UINT(0, fake_flash.erases);
}

static void test_rubbish_in_either_page_is_no_blank_flash(void)
{
    for (unsigned page = 0; page < FLASH_PAGES; page++) {
        setUp();
        fake_flash.bytes[page][5] = 0;
        TEST_ASSERT_EQUAL(HAL_E_STORE, start());
    }
}

static void test_worn_records_are_passed_over(void)
{
    fake_flash.worn[0] = 2;
    save_many(2);
    assert_found(1);
}

static void test_a_mark_that_cannot_be_written_is_done_without(void)
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

static void test_what_seemed_to_fail_never_wins_over_what_was_saved_next(void)
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

static void test_what_seemed_to_fail_never_wins_over_the_old_memory_saved_again(void)
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
static void test_a_record_that_recovers_never_wins_over_a_later_one(void)
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

static void test_a_page_worn_all_over_never_costs_the_memory_in_the_other(void)
{
    save_many(CHANGES);
    fake_flash.worn[1] = 0xFF;
    for (unsigned tries = 0; tries < 5; tries++)
        TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(CHANGES - 1);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_page_is_erased_once_for_a_page_of_records);
    RUN_TEST(test_without_leave_nothing_is_erased);
    RUN_TEST(test_what_was_put_off_is_saved_with_leave);
    RUN_TEST(test_without_leave_there_is_room_again_after_a_start);
    RUN_TEST(test_a_new_chip_has_room_from_the_start_and_is_erased_once);
    RUN_TEST(test_starts_alone_do_not_wear_a_flash_whose_page_is_full);
    RUN_TEST(test_an_erase_that_fails_leaves_the_old_memory);
    RUN_TEST(test_an_erase_that_erases_nothing_leaves_the_old_memory);
    RUN_TEST(test_after_a_start_the_page_in_use_is_filled_first);
    RUN_TEST(test_rubbish_in_either_page_is_no_blank_flash);
    RUN_TEST(test_worn_records_are_passed_over);
    RUN_TEST(test_a_mark_that_cannot_be_written_is_done_without);
    RUN_TEST(test_what_seemed_to_fail_never_wins_over_what_was_saved_next);
    RUN_TEST(test_what_seemed_to_fail_never_wins_over_the_old_memory_saved_again);
    RUN_TEST(test_a_record_that_recovers_never_wins_over_a_later_one);
    RUN_TEST(test_a_page_worn_all_over_never_costs_the_memory_in_the_other);
    return UNITY_END();
}
