#include "hal/boot/choice.h"

#include "tests/test.h"

#include "boot_flash.h"

static struct choices choices;

void setUp(void)
{
    boot_flash_clear();
    (void)choices_open(&choices, CHOICE_PAGE);
}

static const struct choice BOTH = {.installed = 3, .slot = 0}, BOTH_FROM_1 = {.installed = 3, .slot = 1};

static void save(struct choice choice)
{
    TEST_ASSERT_EQUAL(0, choices_save(&choices, &choice, true));
}

TEST(on_a_blank_chip_nothing_is_chosen)
{
    TEST_ASSERT_EQUAL(0, choices_open(&choices, CHOICE_PAGE));
    TEST_ASSERT_EQUAL_UINT8(0, choices.now.installed);
}

TEST(what_was_saved_is_there_after_a_start)
{
    struct choice all = {.floor = 0x12345678, .installed = 2, .slot = 1, .trial = true, .starts = 3, .node = 31, .bitrate = 4};

    save(all);
    TEST_ASSERT_EQUAL(1, choices_open(&choices, CHOICE_PAGE));
    TEST_ASSERT_EQUAL_HEX32(all.floor, choices.now.floor);
    TEST_ASSERT_EQUAL_UINT8(2, choices.now.installed);
    TEST_ASSERT_EQUAL_UINT8(1, choices.now.slot);
    TEST_ASSERT_TRUE(choices.now.trial);
    TEST_ASSERT_EQUAL_UINT8(3, choices.now.starts);
    TEST_ASSERT_EQUAL_UINT8(31, choices.now.node);
    TEST_ASSERT_EQUAL_UINT8(4, choices.now.bitrate);
}

TEST(what_is_no_choice_of_ours_counts_as_none)
{
    uint8_t bytes[CELL_COUNT] = {0, 0, 0, 0, 3, 0, 0, 0xC0};

    TEST_ASSERT_EQUAL(0, flash_store_save(&choices.store, bytes, true));
    TEST_ASSERT_EQUAL(0, choices_open(&choices, CHOICE_PAGE));
    TEST_ASSERT_EQUAL_UINT8(0, choices.now.installed);
}

TEST(a_bit_rate_that_nobody_knows_is_that_of_the_build)
{
    uint8_t bytes[CELL_COUNT] = {0, 0, 0, 0, 3, 0, BITRATES, 0xC1};

    for (; bytes[6] <= BITRATES + 1; bytes[6]++) {
        TEST_ASSERT_EQUAL(0, flash_store_save(&choices.store, bytes, true));
        TEST_ASSERT_EQUAL(1, choices_open(&choices, CHOICE_PAGE));
        TEST_ASSERT_EQUAL_UINT8(0, choices.now.bitrate);
    }
}

TEST(what_has_to_wait_for_an_erase_does_not_hold_yet)
{
    struct choice next = BOTH;

    for (unsigned i = 0; i < PAGE && choices_save(&choices, &next, false) == 0; i++)
        next.floor++;
    TEST_ASSERT_EQUAL(FLASH_STORE_LATER, choices_save(&choices, &next, false));
    TEST_ASSERT_EQUAL_UINT32(next.floor - 1, choices.now.floor);
}

TEST(what_could_not_be_saved_does_not_hold)
{
    boot_flash.failing = true;
    TEST_ASSERT_EQUAL(HAL_E_STORE, choices_save(&choices, &BOTH, true));
    TEST_ASSERT_EQUAL_UINT8(0, choices.now.installed);
}

TEST(an_update_goes_to_the_slot_of_no_confirmed_image)
{
    struct choice choice = BOTH;

    TEST_ASSERT_EQUAL_UINT8(1, choice_free_slot(&choice));
    choice.slot = 1;
    TEST_ASSERT_EQUAL_UINT8(0, choice_free_slot(&choice));
    choice.trial = true;
    TEST_ASSERT_EQUAL_UINT8(1, choice_free_slot(&choice));
    choice = (struct choice){.installed = 0};
    TEST_ASSERT_EQUAL_UINT8(0, choice_free_slot(&choice));
}

TEST(while_a_slot_is_written_the_other_image_starts)
{
    struct choice cleared = choice_cleared(&BOTH);
    struct choice trial = {.installed = 3, .slot = 1, .trial = true, .starts = 2, .floor = 9};

    TEST_ASSERT_EQUAL_UINT8(1, cleared.installed);
    TEST_ASSERT_EQUAL_UINT8(0, cleared.slot);
    cleared = choice_cleared(&BOTH_FROM_1);
    TEST_ASSERT_EQUAL_UINT8(2, cleared.installed);
    TEST_ASSERT_EQUAL_UINT8(1, cleared.slot);
    cleared = choice_cleared(&trial);
    TEST_ASSERT_EQUAL_UINT8(1, cleared.installed);
    TEST_ASSERT_EQUAL_UINT8(0, cleared.slot);
    TEST_ASSERT_FALSE(cleared.trial);
    TEST_ASSERT_EQUAL_UINT8(0, cleared.starts);
    TEST_ASSERT_EQUAL_UINT32(9, cleared.floor);
}

TEST(without_a_damaged_image_the_other_one_starts_if_there_is_one)
{
    struct choice alone = {.installed = 2, .slot = 1};

    TEST_ASSERT_EQUAL_UINT8(1, choice_without(&BOTH).slot);
    TEST_ASSERT_EQUAL_UINT8(0, choice_without(&BOTH_FROM_1).slot);
    TEST_ASSERT_EQUAL_UINT8(1, choice_without(&alone).slot);
}

TEST(a_new_image_is_on_trial_beside_the_old_one)
{
    struct choice cleared = choice_cleared(&BOTH);
    struct choice next;

    cleared.starts = 2;
    next = choice_installed(&cleared);
    TEST_ASSERT_EQUAL_UINT8(3, next.installed);
    TEST_ASSERT_EQUAL_UINT8(1, next.slot);
    TEST_ASSERT_TRUE(next.trial);
    TEST_ASSERT_EQUAL_UINT8(0, next.starts);
}

TEST(an_image_on_trial_has_three_starts_and_then_goes_back)
{
    struct choice choice = {.installed = 3, .slot = 1, .trial = true};

    for (uint8_t start = 1; start <= TRIAL_STARTS; start++) {
        choice = choice_started(&choice);
        TEST_ASSERT_EQUAL_UINT8(start, choice.starts);
        TEST_ASSERT_EQUAL_UINT8(1, choice.slot);
    }
    choice = choice_started(&choice);
    TEST_ASSERT_EQUAL_UINT8(0, choice.slot);
    TEST_ASSERT_EQUAL_UINT8(1, choice.installed);
    TEST_ASSERT_FALSE(choice.trial);
}

TEST(one_with_more_starts_than_there_are_goes_back_too)
{
    struct choice choice = {.installed = 3, .slot = 1, .trial = true, .starts = TRIAL_STARTS + 1};

    TEST_ASSERT_EQUAL_UINT8(0, choice_started(&choice).slot);
}

TEST(with_nothing_to_go_back_to_it_stays)
{
    struct choice choice = {.installed = 2, .slot = 1, .trial = true, .starts = TRIAL_STARTS};

    choice = choice_started(&choice);
    TEST_ASSERT_EQUAL_UINT8(1, choice.slot);
    TEST_ASSERT_EQUAL_UINT8(TRIAL_STARTS, choice.starts);
    TEST_ASSERT_TRUE(choice.trial);
}

TEST(a_confirmed_image_counts_no_starts)
{
    struct choice choice = choice_started(&BOTH);

    TEST_ASSERT_EQUAL_UINT8(0, choice.starts);
    TEST_ASSERT_EQUAL_UINT8(BOTH.installed, choice.installed);
    TEST_ASSERT_EQUAL_UINT8(BOTH.slot, choice.slot);
    TEST_ASSERT_FALSE(choice.trial);
}

TEST(a_confirmed_image_raises_the_floor_and_never_lowers_it)
{
    struct choice trial = {.installed = 3, .slot = 1, .trial = true, .starts = 1, .floor = 5};
    struct choice confirmed = choice_confirmed(&trial, 7);

    TEST_ASSERT_FALSE(confirmed.trial);
    TEST_ASSERT_EQUAL_UINT8(0, confirmed.starts);
    TEST_ASSERT_EQUAL_UINT32(7, confirmed.floor);
    confirmed = choice_confirmed(&trial, 4);
    TEST_ASSERT_EQUAL_UINT32(5, confirmed.floor);
}
