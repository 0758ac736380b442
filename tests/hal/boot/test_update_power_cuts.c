/* The power fails at each flash operation of an update, and at those of the recovery. Whatever happens, the next start has an
 * image, old or new, and the same update then succeeds. */
#include "hal/boot/start.h"

#include <string.h>

#include "tests/test.h"

#include "tester.h"

enum { OLD = 5, NEW = 6, FIRST_STEP = 1, SECOND_STEP = 301 };

static struct boot_flash before, cut_once;
static struct signed_image next;

/* A chip in use: an image of a probe's in slot 0, and one updated before in slot 1. */
static void begin(void)
{
    boot_flash_clear();
    signer_put(0, OLD);
    tester_power_on();
    TEST_ASSERT_EQUAL(0, start_pick(&choices));
    next = signer_image(1, NEW);
    before = boot_flash;
}

static void assert_starts(bool may_be_new)
{
    struct image image;
    int slot;

    tester_power_on();
    slot = start_pick(&choices);
    TEST_ASSERT_NOT_EQUAL_INT(SLOT_NONE, slot);
    TEST_ASSERT_EQUAL(REFUSAL_NONE, image_verify((unsigned)slot, &image));
    if (!may_be_new)
        TEST_ASSERT_EQUAL_UINT32(OLD, image.version);
}

/* Goes on where it was: as a tester does, from what is written and fits. */
static int resume(void)
{
    uint32_t from = image_written(1) < SIGNED_BYTES ? image_written(1) : 0;
    int result;

    if (memcmp(boot_flash_slot(1), next.bytes, from) != 0)
        from = 0;
    unlock();
    result = erase_for(&next, from);
    if (result == 0)
        result = download(&next, from);
    return result != 0 ? result : check();
}

/* The tester's side of it, and then the new image's. */
static void all(void)
{
    struct choice confirmed;

    if (!(choices.now.installed & 2)) {
        TEST_ASSERT_EQUAL_HEX8(0, resume());
        tester_power_on();
        TEST_ASSERT_EQUAL(1, start_pick(&choices));
    }
    confirmed = choice_confirmed(&choices.now, NEW);
    TEST_ASSERT_EQUAL(0, choices_save(&choices, &confirmed, true));
}

/* False: it came to its end before the power was to fail. */
static bool is_cut(unsigned at)
{
    boot_flash.operations = 0;
    boot_flash.cut_at = at;
    if (setjmp(boot_flash.cut) != 0) {
        boot_flash.cut_at = 0;
        return true;
    }
    tester_power_on();
    (void)start_pick(&choices);
    all();
    boot_flash.cut_at = 0;
    return false;
}

static void assert_done(void)
{
    tester_power_on();
    TEST_ASSERT_EQUAL(1, start_pick(&choices));
    TEST_ASSERT_FALSE(choices.now.trial);
    TEST_ASSERT_EQUAL_MEMORY(next.bytes, boot_flash_slot(1), SIGNED_BYTES);
}

TEST(whenever_the_power_fails_an_image_starts_and_the_update_can_go_on)
{
    unsigned cuts = 0;

    begin();
    for (unsigned at = 1; is_cut(at); at += FIRST_STEP) {
        assert_starts(true);
        (void)is_cut(0);
        assert_done();
        boot_flash = before;
        cuts++;
    }
    assert_done();
    TEST_ASSERT_GREATER_THAN_UINT(300, cuts);
}

TEST(and_again_while_it_goes_on)
{
    begin();
    for (unsigned first = 1; is_cut(first); first += SECOND_STEP) {
        cut_once = boot_flash;
        for (unsigned second = 1; is_cut(second); second += FIRST_STEP) {
            assert_starts(true);
            (void)is_cut(0);
            assert_done();
            boot_flash = cut_once;
        }
        boot_flash = before;
    }
}

TEST(until_the_new_image_was_checked_the_old_one_starts)
{
    begin();
    unlock();
    TEST_ASSERT_EQUAL(0, erase_for(&next, 0));
    assert_starts(false);
    unlock();
    TEST_ASSERT_EQUAL(0, erase_for(&next, 0));
    TEST_ASSERT_EQUAL(0, download(&next, 0));
    assert_starts(false);
}
