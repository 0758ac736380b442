#include "flash_store_rig.h"

#include "tests/test.h"
#include "hal/flash_store/flash_store.h"

#include <string.h>

enum { NO_MEMORY = 200, CYCLES_MAX = 3 };

static struct {
    unsigned memories[1 + CYCLES_MAX];   /* those that a start may find, the oldest first */
    unsigned count;
} allowed;

/* A memory that a start has loaded stays: later starts load neither an older one nor one whose save failed. */
static void check_start(void)
{
    int result = start();

    for (unsigned i = 0; i < allowed.count; i++) {
        unsigned n = allowed.memories[i];

        if (n == NO_MEMORY ? result <= 0 : result == 1 && memcmp(found, memory_number(n), CELL_COUNT) == 0) {
            allowed.memories[0] = n;
            allowed.count = 1;
            return;
        }
    }
    TEST_FAIL_MESSAGE("neither the old memory nor the new one");
}

/* A power cycle: start and save, with a cut at operation `at`. False: there were fewer operations. */
static bool cycle_is_cut(unsigned n, unsigned at, unsigned damage)
{
    fake_flash.operations = 0;
    fake_flash.cut_at = at;
    fake_flash.damage = damage;
    if (setjmp(fake_flash.cut) != 0) {
        fake_flash.cut_at = 0;
        return true;
    }
    check_start();
    allowed.memories[allowed.count++] = n;
    TEST_ASSERT_EQUAL(0, save(n));
    fake_flash.cut_at = 0;
    allowed.memories[0] = n;
    allowed.count = 1;
    return false;
}

static void begin_with(unsigned before)
{
    setUp();
    allowed.memories[0] = NO_MEMORY;
    allowed.count = 1;
    if (before == 0)
        return;
    save_many(before);
    allowed.memories[0] = before - 1;
}

/* Two power cycles are cut, the third one saves. False: one of the two was not cut. */
static bool is_cut_twice(unsigned before, unsigned first, unsigned second, unsigned damage)
{
    bool cut;

    begin_with(before);
    if (!cycle_is_cut(100, first, damage))
        return false;
    cut = cycle_is_cut(101, second, damage);
    TEST_ASSERT_FALSE(cycle_is_cut(102, 0, 0));
    assert_found(102);
    return cut;
}

static bool is_cut_once(unsigned before, unsigned at)
{
    begin_with(before);
    return cycle_is_cut(100, at, 0);
}

static void cut_everywhere(unsigned before)
{
    for (unsigned first = 1; is_cut_once(before, first); first++)
        for (unsigned damage = 0; damage < FAKE_DAMAGES; damage++)
            for (unsigned second = 1; is_cut_twice(before, first, second, damage); second++)
                continue;
}

TEST(power_cut_anywhere_twice_in_a_row_leaves_old_or_new)
{
    FOR_EACH_KIND
        for (unsigned before = 0; before <= 3 * CHANGES; before++)
            cut_everywhere(before);
}

/* Zeros over a mark, an erase, a mark and a record, step by step. */
TEST(power_cuts_reach_every_operation)
{
    FOR_EACH_KIND {
        unsigned last;

        setUp();
        last = 1 + 3 * fake_flash_place() / kind->step;
        TEST_ASSERT_TRUE(is_cut_once(2 * CHANGES, last));
        TEST_ASSERT_FALSE(is_cut_once(2 * CHANGES, last + 1));
    }
}

/* After zeros over the mark. */
static unsigned erase_operation(void)
{
    return fake_flash_place() / kind->step + 1;
}

TEST(page_with_interrupted_erase_is_erased_again_though_blank)
{
    begin_with(2 * CHANGES);
    TEST_ASSERT_TRUE(cycle_is_cut(100, erase_operation(), 2));
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, fake_flash.bytes[0], CHANGES * 16);
    TEST_ASSERT_FALSE(cycle_is_cut(101, 0, 0));
    TEST_ASSERT_EQUAL_UINT(4, fake_flash.erases);
}

TEST(page_mark_does_not_survive_an_interrupted_erase)
{
    FOR_EACH_KIND {
        begin_with(2 * CHANGES);
        TEST_ASSERT_TRUE(cycle_is_cut(100, erase_operation(), FAKE_DAMAGES - 1));
        TEST_ASSERT_EACH_EQUAL_HEX8(0, fake_flash.bytes[0], fake_flash_place());
        TEST_ASSERT_FALSE(cycle_is_cut(101, 0, 0));
        TEST_ASSERT_EQUAL_UINT(4, fake_flash.erases);
    }
}

TEST(unreadable_unit_is_skipped_and_not_blank)
{
    for (kind = KINDS; !kind->corrects; kind++)
        continue;
    setUp();
    save_many(2);
    fake_flash.unreadable[0] = 1u << 2 * 16 / 4;
    assert_found(0);
    fake_flash.unreadable[0] |= 1u << 16 / 4;
    TEST_ASSERT_EQUAL(HAL_E_STORE, start());
    TEST_ASSERT_EQUAL(0, save(5));
    assert_found(5);
}

/* When the flash store erases a page, and how it treats worn records. */

TEST(page_is_erased_once_per_page_of_records)
{
    save_many(10 * CHANGES);
    TEST_ASSERT_EQUAL_UINT(10, fake_flash.erases);
}

TEST(store_erases_nothing_without_permission)
{
    save_many(2 * CHANGES);
    fake_flash.erases = 0;
    TEST_ASSERT_EQUAL(FLASH_STORE_LATER, flash_store_save(&store, memory_number(99), false));
    TEST_ASSERT_EQUAL_UINT(0, fake_flash.erases);
    assert_found(2 * CHANGES - 1);
}

TEST(postponed_save_happens_with_permission)
{
    save_many(2 * CHANGES);
    (void)flash_store_save(&store, memory_number(99), false);
    TEST_ASSERT_EQUAL(0, save(99));
    assert_found(99);
}

TEST(start_erases_a_full_page_for_later_saves)
{
    save_many(2 * CHANGES);
    assert_found(2 * CHANGES - 1);
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory_number(99), false));
    assert_found(99);
}

TEST(new_chip_is_erased_once_and_has_room)
{
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL(0, flash_store_save(&store, memory_number(7), false));
    TEST_ASSERT_EQUAL_UINT(1, fake_flash.erases);
    assert_found(7);
}

TEST(repeated_starts_erase_a_full_flash_once)
{
    save_many(3 * CHANGES);
    for (unsigned i = 0; i < 10; i++)
        assert_found(3 * CHANGES - 1);
    TEST_ASSERT_EQUAL_UINT(4, fake_flash.erases);
}

TEST(failed_erase_leaves_the_old_memory)
{
    save_many(2 * CHANGES);
    fake_flash.erase_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * CHANGES - 1);
}

TEST(ineffective_erase_leaves_the_old_memory)
{
    save_many(2 * CHANGES);
    fake_flash.erase_does_nothing = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(2 * CHANGES - 1);
}

TEST(start_continues_filling_the_page_in_use)
{
    save_many(CHANGES + 1);
    fake_flash.erases = 0;
    assert_found(CHANGES);
    TEST_ASSERT_EQUAL(0, save(99));
    TEST_ASSERT_EQUAL_UINT(0, fake_flash.erases);
}

TEST(store_with_garbage_in_a_page_reports_an_error)
{
    for (unsigned page = 0; page < FLASH_PAGES; page++) {
        setUp();
        fake_flash.bytes[page][5] = 0;
        TEST_ASSERT_EQUAL(HAL_E_STORE, start());
    }
}

TEST(worn_records_are_skipped)
{
    fake_flash.worn[0] = 2;
    save_many(2);
    assert_found(1);
}

TEST(store_works_with_a_page_mark_that_cannot_be_written)
{
    fake_flash.worn[0] = 1;
    save_many(2);
    assert_found(1);
    TEST_ASSERT_EQUAL(0, save(2));
    TEST_ASSERT_EQUAL_UINT(1, fake_flash.erases);
    assert_found(2);
}

static void save_with_write_error(unsigned n)
{
    fake_flash.write_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, save(n));
    fake_flash.write_fails = false;
}

TEST(failed_save_never_replaces_the_next_save)
{
    FOR_EACH_KIND
        for (unsigned before = 1; before < 3 * CHANGES; before++) {
            setUp();
            save_many(before);
            save_with_write_error(100);
            TEST_ASSERT_EQUAL(0, save(101));
            assert_found(101);
        }
}

TEST(failed_save_never_replaces_a_resaved_old_memory)
{
    for (unsigned before = 1; before < 3 * CHANGES; before++) {
        setUp();
        save_many(before);
        save_with_write_error(100);
        TEST_ASSERT_EQUAL(0, save(before - 1));
        assert_found(before - 1);
    }
}

/* A record that read as damaged when its successor was saved reads well at the next start. */
TEST(recovered_record_never_replaces_a_later_one)
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

TEST(fully_worn_page_leaves_the_memory_in_the_other)
{
    save_many(CHANGES);
    fake_flash.worn[1] = 0xFF;
    for (unsigned tries = 0; tries < 5; tries++)
        TEST_ASSERT_EQUAL(HAL_E_STORE, save(99));
    assert_found(CHANGES - 1);
}

TEST(stores_in_different_pages_alternate_independently)
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
