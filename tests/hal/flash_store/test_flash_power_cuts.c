#include "hal/flash_store/flash_store.h"

#include <string.h>

#include "tests/test.h"
#include "fake_flash.h"

#include "flash_store_rig.h"

enum { NO_MEMORY = 200, LIVES_MAX = 3 };

static struct {
    unsigned memories[1 + LIVES_MAX];   /* those that a start may find, the oldest first */
    unsigned count;
} allowed;

/* What a start has found is there to stay: nothing older comes back, and nothing that failed to be written turns up. */
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

/* Power comes, and fails at one operation of a start and a save. False: it did not come to that. */
static bool life_is_cut(unsigned n, unsigned at, unsigned damage)
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

/* The power fails in two lives, and the third one saves in peace. False: one of the two was not cut. */
static bool is_cut_twice(unsigned before, unsigned first, unsigned second, unsigned damage)
{
    bool cut;

    begin_with(before);
    if (!life_is_cut(100, first, damage))
        return false;
    cut = life_is_cut(101, second, damage);
    TEST_ASSERT_FALSE(life_is_cut(102, 0, 0));
    assert_found(102);
    return cut;
}

static bool is_cut_once(unsigned before, unsigned at)
{
    begin_with(before);
    return life_is_cut(100, at, 0);
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
TEST(the_power_cuts_reach_every_operation)
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
static unsigned the_erase(void)
{
    return fake_flash_place() / kind->step + 1;
}

TEST(a_page_whose_erase_was_cut_short_is_erased_again_though_it_reads_blank)
{
    begin_with(2 * CHANGES);
    TEST_ASSERT_TRUE(life_is_cut(100, the_erase(), 2));
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, fake_flash.bytes[0], CHANGES * 16);
    TEST_ASSERT_FALSE(life_is_cut(101, 0, 0));
    TEST_ASSERT_EQUAL_UINT(4, fake_flash.erases);
}

TEST(a_mark_does_not_outlive_an_erase_that_was_cut_short)
{
    FOR_EACH_KIND {
        begin_with(2 * CHANGES);
        TEST_ASSERT_TRUE(life_is_cut(100, the_erase(), FAKE_DAMAGES - 1));
        TEST_ASSERT_EACH_EQUAL_HEX8(0, fake_flash.bytes[0], fake_flash_place());
        TEST_ASSERT_FALSE(life_is_cut(101, 0, 0));
        TEST_ASSERT_EQUAL_UINT(4, fake_flash.erases);
    }
}

TEST(an_unreadable_unit_is_passed_over_and_no_blank_flash)
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
