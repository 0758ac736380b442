#include "hal/flash_store/flash_store.h"

#include <string.h>

#include <unity.h>

#include "fake_flash.h"

enum { DAMAGES = 3, OPERATIONS_MAX = 9 };   /* of one save: an erase and eight half-words */

static struct flash_store store;
static uint8_t found[CELL_COUNT];

void setUp(void)
{
    fake_flash_clear();
    memset(&store, 0xA5, sizeof store);
}

void tearDown(void) {}

/* Any two differ in every byte but the first, so that a mix of two is neither. */
static const uint8_t *memory_number(unsigned n)
{
    static uint8_t memory[CELL_COUNT];

    memory[0] = 0;
    for (unsigned p = 1; p < CELL_COUNT; p++)
        memory[p] = (uint8_t)(n + 1);
    return memory;
}

static int start(void)
{
    memset(found, 0, sizeof found);
    return flash_store_open(&store, found);
}

static int save(unsigned n)
{
    return flash_store_save(&store, memory_number(n), true);
}

static void save_many(unsigned count)
{
    TEST_ASSERT_TRUE(start() >= 0);
    for (unsigned n = 0; n < count; n++)
        TEST_ASSERT_EQUAL(0, save(n));
}

static void assert_found(unsigned n)
{
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL_UINT8_ARRAY(memory_number(n), found, CELL_COUNT);
}

static void test_a_blank_flash_holds_no_memory(void)
{
    TEST_ASSERT_EQUAL(0, start());
}

static void test_what_was_saved_is_found(void)
{
    save_many(1);
    assert_found(0);
}

static void test_the_newest_of_many_is_found(void)
{
    for (unsigned count = 1; count <= 5 * FAKE_RECORDS; count++) {
        setUp();
        save_many(count);
        assert_found(count - 1);
    }
}

static void test_a_page_is_erased_once_for_a_page_of_records(void)
{
    save_many(10 * FAKE_RECORDS);
    TEST_ASSERT_EQUAL_UINT(8, fake_flash.erases);   /* the first two pages were blank */
}

static void test_random_bytes_are_no_memory_and_the_robot_starts(void)
{
    memset(fake_flash.bytes, 0x3C, sizeof fake_flash.bytes);
    TEST_ASSERT_EQUAL(HAL_E_STORE, start());
    TEST_ASSERT_EQUAL(0, save(5));
    assert_found(5);
}

static void test_zeros_are_no_memory(void)
{
    memset(fake_flash.bytes, 0, sizeof fake_flash.bytes);
    TEST_ASSERT_EQUAL(HAL_E_STORE, start());
}

static void test_one_flipped_bit_makes_the_record_before_it_count(void)
{
    for (unsigned bit = 0; bit < 8 * 16; bit++) {
        setUp();
        save_many(2);
        fake_flash.bytes[0][16 + bit / 8] ^= (uint8_t)(1u << bit % 8);
        assert_found(0);
    }
}

static void test_without_leave_nothing_is_erased(void)
{
    save_many(2 * FAKE_RECORDS);
    TEST_ASSERT_EQUAL(FLASH_STORE_LATER, flash_store_save(&store, memory_number(99), false));
    TEST_ASSERT_EQUAL_UINT(0, fake_flash.erases);
    assert_found(2 * FAKE_RECORDS - 1);
}

static void test_what_was_put_off_is_saved_with_leave(void)
{
    save_many(2 * FAKE_RECORDS);
    (void)flash_store_save(&store, memory_number(99), false);
    TEST_ASSERT_EQUAL(0, save(99));
    assert_found(99);
}

static void test_without_leave_a_blank_page_is_still_used(void)
{
    save_many(FAKE_RECORDS);
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory_number(99), false));
    assert_found(99);
}

static void test_an_erase_that_fails_leaves_the_old_memory(void)
{
    save_many(2 * FAKE_RECORDS);
    fake_flash.erase_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * FAKE_RECORDS - 1);
}

static void test_an_erase_that_erases_nothing_leaves_the_old_memory(void)
{
    save_many(2 * FAKE_RECORDS);
    fake_flash.erase_does_nothing = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * FAKE_RECORDS - 1);
}

static void test_after_a_start_the_page_in_use_is_filled_first(void)
{
    save_many(FAKE_RECORDS + 1);
    assert_found(FAKE_RECORDS);
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
    fake_flash.worn[0] = 1 | 4;
    save_many(2);
    assert_found(1);
}

static void test_a_page_worn_all_over_never_costs_the_memory_in_the_other(void)
{
    save_many(FAKE_RECORDS);
    fake_flash.worn[1] = 0xFF;
    for (unsigned tries = 0; tries < 5; tries++)
        TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(FAKE_RECORDS - 1);
}

/* Saves with the power failing at one operation. True: it came to that. */
static bool save_is_cut(unsigned n, unsigned at, unsigned damage)
{
    fake_flash.operations = 0;
    fake_flash.cut_at = at;
    fake_flash.damage = damage;
    if (setjmp(fake_flash.cut) != 0)
        return true;
    TEST_ASSERT_EQUAL(0, save(n));
    fake_flash.cut_at = 0;
    return false;
}

/* Powers up, and says which memory is there: old or new, and nothing else. Where there was none yet, old may be none. */
static unsigned found_after_cut(unsigned old, unsigned new)
{
    int result = start();

    fake_flash.cut_at = 0;
    if (result <= 0) {
        TEST_ASSERT_EQUAL_UINT(0, old);   /* number 0 stands for none */
        return old;
    }
    if (memcmp(found, memory_number(new), CELL_COUNT) == 0)
        return new;
    TEST_ASSERT_EQUAL_UINT8_ARRAY(memory_number(old), found, CELL_COUNT);
    return old;
}

/* Cuts the save of memory 100 at one operation, starts, cuts that of 101 at another, starts, and saves 102 in peace. */
static void cut_twice(unsigned before, unsigned first, unsigned second, unsigned damage)
{
    unsigned kept = before > 0 ? before - 1 : 0;
    bool cut;

    setUp();
    save_many(before);
    cut = save_is_cut(100, first, damage);
    kept = found_after_cut(kept, 100);
    TEST_ASSERT_TRUE(cut || kept == 100);
    cut = save_is_cut(101, second, damage);
    kept = found_after_cut(kept, 101);
    TEST_ASSERT_TRUE(cut || kept == 101);
    TEST_ASSERT_EQUAL(0, save(102));
    assert_found(102);
}

static void test_power_cut_anywhere_twice_in_a_row_leaves_old_or_new(void)
{
    for (unsigned before = 0; before <= 3 * FAKE_RECORDS; before++)
        for (unsigned first = 1; first <= OPERATIONS_MAX + 1; first++)
            for (unsigned second = 1; second <= OPERATIONS_MAX + 1; second++)
                for (unsigned damage = 0; damage < DAMAGES; damage++)
                    cut_twice(before, first, second, damage);
}

static void test_the_power_cuts_reach_every_operation(void)
{
    save_many(2 * FAKE_RECORDS);
    fake_flash.operations = 0;
    TEST_ASSERT_EQUAL(0, save(99));
    TEST_ASSERT_EQUAL_UINT(OPERATIONS_MAX, fake_flash.operations);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_blank_flash_holds_no_memory);
    RUN_TEST(test_what_was_saved_is_found);
    RUN_TEST(test_the_newest_of_many_is_found);
    RUN_TEST(test_a_page_is_erased_once_for_a_page_of_records);
    RUN_TEST(test_random_bytes_are_no_memory_and_the_robot_starts);
    RUN_TEST(test_zeros_are_no_memory);
    RUN_TEST(test_one_flipped_bit_makes_the_record_before_it_count);
    RUN_TEST(test_without_leave_nothing_is_erased);
    RUN_TEST(test_what_was_put_off_is_saved_with_leave);
    RUN_TEST(test_without_leave_a_blank_page_is_still_used);
    RUN_TEST(test_an_erase_that_fails_leaves_the_old_memory);
    RUN_TEST(test_an_erase_that_erases_nothing_leaves_the_old_memory);
    RUN_TEST(test_after_a_start_the_page_in_use_is_filled_first);
    RUN_TEST(test_rubbish_in_either_page_is_no_blank_flash);
    RUN_TEST(test_worn_records_are_passed_over);
    RUN_TEST(test_a_page_worn_all_over_never_costs_the_memory_in_the_other);
    RUN_TEST(test_power_cut_anywhere_twice_in_a_row_leaves_old_or_new);
    RUN_TEST(test_the_power_cuts_reach_every_operation);
    return UNITY_END();
}
