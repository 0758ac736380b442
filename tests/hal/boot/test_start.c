#include "hal/boot/start.h"

#include "tests/test.h"

#include "signer.h"

static struct choices choices;

void setUp(void)
{
    boot_flash_clear();
    (void)choices_open(&choices, CHOICE_PAGE);
}

static int start(void)
{
    (void)choices_open(&choices, CHOICE_PAGE);
    return start_pick(&choices);
}

static void choose(struct choice choice)
{
    TEST_ASSERT_EQUAL(0, choices_save(&choices, &choice, true));
}

TEST(a_chip_without_an_image_starts_none)
{
    TEST_ASSERT_EQUAL(SLOT_NONE, start());
}

TEST(what_a_probe_has_written_starts_if_it_is_signed)
{
    signer_put(0, 5);
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL_UINT8(1, choices.now.installed);
    TEST_ASSERT_FALSE(choices.now.trial);
    TEST_ASSERT_EQUAL_UINT32(5, choices.now.floor);
    boot_flash_clear();
    signer_put(0, 5);
    boot_flash_slot(0)[SIGNED_BYTES - 1] ^= 1;
    TEST_ASSERT_EQUAL(SLOT_NONE, start());
}

TEST(of_two_that_a_probe_has_written_the_newer_one_starts)
{
    signer_put(0, 5);
    signer_put(1, 6);
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL_UINT8(3, choices.now.installed);
    boot_flash_clear();
    signer_put(0, 7);
    signer_put(1, 6);
    TEST_ASSERT_EQUAL(0, start());
}

TEST(an_image_that_is_confirmed_starts_and_nothing_is_written)
{
    signer_put(0, 5);
    (void)start();
    boot_flash.operations = 0;
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL_UINT(0, boot_flash.operations);
}

TEST(an_image_on_trial_starts_three_times_and_then_the_old_one_does)
{
    signer_put(0, 5);
    signer_put(1, 6);
    choose((struct choice){.installed = 3, .slot = 1, .trial = true});
    for (unsigned i = 0; i < TRIAL_STARTS; i++)
        TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL_UINT8(1, choices.now.installed);
}

TEST(an_image_that_is_damaged_gives_way_to_the_other)
{
    signer_put(0, 5);
    signer_put(1, 6);
    choose((struct choice){.installed = 3, .slot = 1});
    boot_flash_slot(1)[300] ^= 1;
    TEST_ASSERT_EQUAL(0, start());
    boot_flash_slot(0)[300] ^= 1;
    TEST_ASSERT_EQUAL(SLOT_NONE, start());
}

TEST(an_image_that_was_not_found_to_be_signed_does_not_start)
{
    signer_put(1, 6);
    choose((struct choice){.installed = 1, .slot = 0});
    TEST_ASSERT_EQUAL(SLOT_NONE, start());
}

TEST(a_start_on_trial_that_cannot_be_counted_goes_back)
{
    signer_put(0, 5);
    signer_put(1, 6);
    choose((struct choice){.installed = 3, .slot = 1, .trial = true});
    boot_flash.failing = true;
    TEST_ASSERT_EQUAL(0, start());
    boot_flash.failing = false;
    TEST_ASSERT_EQUAL(1, start());
}

TEST(its_number_and_the_bit_rate_outlive_the_images)
{
    choose((struct choice){.installed = 0, .node = 3, .bitrate = 2});
    signer_put(0, 5);
    TEST_ASSERT_EQUAL(0, start());
    TEST_ASSERT_EQUAL_UINT8(3, choices.now.node);
    TEST_ASSERT_EQUAL_UINT8(2, choices.now.bitrate);
}
