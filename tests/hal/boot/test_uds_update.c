#include "hal/boot/uds.h"

#include <string.h>

#include "tests/test.h"

#include "hal/boot/start.h"

#include "tester.h"

static struct signed_image image;

void setUp(void)
{
    image = tester_begin();
}

static void assert_refused(int code, enum refusal why)
{
    TEST_ASSERT_EQUAL_HEX8(code, update(&image));
    TEST_ASSERT_EQUAL_UINT8(why, uds.why);
    tester_power_on();
    TEST_ASSERT_EQUAL(0, start_pick(&choices));
}

/* Before anything was erased. */
static void assert_refused_early(int code, enum refusal why)
{
    signer_put(1, 4);
    assert_refused(code, why);
    TEST_ASSERT_EQUAL_HEX8('O', boot_flash_slot(1)[0]);
}

TEST(an_update_is_on_trial_in_the_other_slot)
{
    TEST_ASSERT_EQUAL_HEX8(0, update(&image));
    TEST_ASSERT_EQUAL_MEMORY(image.bytes, boot_flash_slot(1), SIGNED_BYTES);
    TEST_ASSERT_TRUE(choices.now.trial);
    tester_power_on();
    TEST_ASSERT_EQUAL(1, start_pick(&choices));
}

TEST(a_second_update_takes_the_place_of_one_on_trial)
{
    TEST_ASSERT_EQUAL_HEX8(0, update(&image));
    image = signer_image(1, 7);
    TEST_ASSERT_EQUAL_HEX8(0, update(&image));
    TEST_ASSERT_EQUAL_MEMORY(image.bytes, boot_flash_slot(1), SIGNED_BYTES);
    TEST_ASSERT_EQUAL(1, start_pick(&choices));
}

TEST(a_chip_without_an_image_takes_one)
{
    boot_flash_clear();
    tester_power_on();
    image = signer_image(0, 1);
    TEST_ASSERT_EQUAL_HEX8(0, update(&image));
    TEST_ASSERT_EQUAL(0, start_pick(&choices));
}

TEST(another_board_is_refused_before_anything_is_erased)
{
    image.bytes[36] ^= 1;
    signer_seal(&image);
    assert_refused_early(0x31, REFUSAL_BOARD);
}

TEST(another_chip_another_layout_and_another_slot_are_too)
{
    image.bytes[24] ^= 1;
    assert_refused_early(0x31, REFUSAL_CHIP);
    image.bytes[24] ^= 1;
    image.bytes[22] ^= 1;
    assert_refused_early(0x31, REFUSAL_LAYOUT);
    image = signer_image(0, 6);
    assert_refused_early(0x31, REFUSAL_SLOT);
    memset(image.bytes, 0, 8);
    assert_refused_early(0x31, REFUSAL_MAGIC);
}

TEST(one_that_is_too_long_is_too)
{
    image.bytes[10] = 1;
    assert_refused_early(0x31, REFUSAL_SIZE);
}

TEST(an_older_one_is_too_until_a_person_with_the_key_allows_it)
{
    image = signer_image(1, 4);
    assert_refused_early(0x22, REFUSAL_OLDER);
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0x13, ASK(0x31, 1, 0xF0, 0, 0, 0, 0));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x31, 1, 0xF0, 0, 0, 0, 0, 4));
    TEST_ASSERT_EQUAL_UINT16(5, answered);
    TEST_ASSERT_EQUAL_HEX8(0, update(&image));
}

TEST(one_wrong_bit_is_refused_and_so_is_another_signer)
{
    image.bytes[400] ^= 1;
    assert_refused(0x72, REFUSAL_DAMAGED);
    image.bytes[400] ^= 1;
    image.bytes[SIGNED_BYTES - 2] ^= 1;
    assert_refused(0x72, REFUSAL_SIGNATURE);
}

TEST(another_header_than_the_announced_one_is_refused)
{
    struct signed_image other = signer_image(1, 7);

    unlock();
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, download(&other, 0));
    TEST_ASSERT_EQUAL_HEX8(0x72, check());
    TEST_ASSERT_EQUAL_UINT8(REFUSAL_CHANGED, uds.why);
    other.bytes[400] ^= 1;
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_UINT8(REFUSAL_NONE, uds.why);
    TEST_ASSERT_EQUAL_HEX8(0, download(&other, 0));
    TEST_ASSERT_EQUAL_HEX8(0x72, check());
    TEST_ASSERT_EQUAL_UINT8(REFUSAL_DAMAGED, uds.why);
}

TEST(services_in_a_wrong_order_are_refused)
{
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0x24, check());
    TEST_ASSERT_EQUAL_HEX8(0x24, ASK(0x36, 1, 0, 0, 0, 0));
    TEST_ASSERT_EQUAL_HEX8(0x24, ASK(0x37));
    TEST_ASSERT_EQUAL_HEX8(0x24, download(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0x24, check());
    TEST_ASSERT_EQUAL_HEX8(0, download(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0x24, download(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, check());
    TEST_ASSERT_EQUAL_HEX8(0x24, check());
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, download(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0x24, check());
}

TEST(routines_that_there_are_not_are_refused)
{
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0x12, ASK(0x31, 2, 0xFF, 0));
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x31, 1, 0xFF, 2));
    TEST_ASSERT_EQUAL_HEX8(0x13, ASK(0x31, 1, 0xFF, 1, 0));
    TEST_ASSERT_EQUAL_HEX8(0x13, ASK(0x31, 1, 0xFF, 0, 0));
    TEST_ASSERT_EQUAL_HEX8(0x13, ask((uint8_t[8 + IMAGE_HEADER + 1]){0x31, 1, 0xFF, 0}, 8 + IMAGE_HEADER + 1));
    TEST_ASSERT_EQUAL_HEX8(0x13, ASK(0x31, 1, 0xF0, 0, 0, 0, 0, 4, 0));
}

TEST(behind_the_image_a_page_is_erased_if_it_is_not_blank)
{
    enum { IMAGE_PAGES = (SIGNED_BYTES + PAGE - 1) / PAGE };
    unsigned before;

    unlock();
    before = boot_flash.operations;
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_UINT(before + IMAGE_PAGES, boot_flash.operations);
    boot_flash_slot(1)[SLOT_BYTES - 1] = 0;
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_UINT(before + 2 * IMAGE_PAGES + 1, boot_flash.operations);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, boot_flash_slot(1), SLOT_BYTES);
    image.bytes[8] = (uint8_t)(2 * PAGE - IMAGE_SIGNATURE);
    image.bytes[9] = 1;
    before = boot_flash.operations;
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_UINT(before + 2, boot_flash.operations);
}

TEST(an_erase_goes_on_from_within_the_image_only)
{
    unlock();
    boot_flash_slot(1)[SLOT_BYTES - 1] = 0;
    TEST_ASSERT_EQUAL_HEX8(0x31, erase_for(&image, 3 * PAGE));
    image.bytes[8] = 0;
    image.bytes[9] = 2 * PAGE >> 8;
    TEST_ASSERT_EQUAL_HEX8(0x31, erase_for(&image, 2 * PAGE));
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, PAGE));
}

TEST(what_was_written_is_told_and_gone_on_from)
{
    TEST_ASSERT_EQUAL_HEX8(0, update(&image));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xFD, 1));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0, 0, 2, 0}), &answer[3], 4);
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0x31, erase_for(&image, 100));
    TEST_ASSERT_EQUAL_HEX8(0x31, erase_for(&image, 3 * PAGE));
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 2 * PAGE));
    TEST_ASSERT_EQUAL_MEMORY(image.bytes, boot_flash_slot(1), 2 * PAGE);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, boot_flash_slot(1) + 2 * PAGE, SLOT_BYTES - 2 * PAGE);
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x34, 0, 0x44, 0, 0, 0, 0, 0, 0, 0, SIGNED_BYTES - 2 * PAGE));
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x34, 0, 0x44, 0, 0, 2, 0, 0, 0, 0, SIGNED_BYTES - 2 * PAGE + 1));
    TEST_ASSERT_EQUAL_HEX8(0, download(&image, 2 * PAGE));
    TEST_ASSERT_EQUAL_HEX8(0, check());
}

TEST(a_slot_that_cannot_be_read_is_begun_anew)
{
    TEST_ASSERT_EQUAL_HEX8(0, update(&image));
    boot_flash.unreadable = SLOT_B;
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xFD, 1));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0, 0, 0, 0}), &answer[3], 4);
}

TEST(a_flash_that_fails_is_told)
{
    unlock();
    boot_flash.failing = true;
    TEST_ASSERT_EQUAL_HEX8(0x72, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_UINT8(REFUSAL_FLASH, uds.why);
    TEST_ASSERT_EQUAL_HEX8(0x72, ASK(0x31, 1, 0xF0, 0, 0, 0, 0, 4));
    boot_flash.failing = false;
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, announce(0));
    boot_flash.failing = true;
    TEST_ASSERT_FALSE(uds_ahead(&uds, (const uint8_t[]){0x36, 1, 'O', 'C', 'T', 'E'}, 6));
    TEST_ASSERT_EQUAL_HEX8(0x72, ASK(0x36, 1, 'O', 'C', 'T', 'E'));
    TEST_ASSERT_EQUAL_UINT8(REFUSAL_FLASH, uds.why);
    TEST_ASSERT_EQUAL_HEX8(0x24, ASK(0x36, 1, 'O', 'C', 'T', 'E'));
    boot_flash.failing = false;
    TEST_ASSERT_FALSE(uds_ahead(&uds, (const uint8_t[]){0x36, 1, 'O', 'C', 'T', 'E'}, 6));
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, download(&image, 0));
    boot_flash.failing = true;
    TEST_ASSERT_EQUAL_HEX8(0x72, check());
    TEST_ASSERT_EQUAL_UINT8(REFUSAL_FLASH, uds.why);
}

TEST(an_image_that_was_there_is_given_up_before_it_is_erased)
{
    TEST_ASSERT_EQUAL_HEX8(0, update(&image));
    unlock();
    boot_flash.failing = true;
    TEST_ASSERT_EQUAL_HEX8(0x72, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_UINT8(REFUSAL_FLASH, uds.why);
    TEST_ASSERT_EQUAL_MEMORY(image.bytes, boot_flash_slot(1), SIGNED_BYTES);
    TEST_ASSERT_EQUAL_UINT8(3, choices.now.installed);
    boot_flash.failing = false;
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_UINT8(1, choices.now.installed);
}

TEST(a_page_of_choices_that_is_full_makes_room)
{
    for (unsigned i = 0; i < 40; i++)
        TEST_ASSERT_EQUAL_HEX8(0, update(&image));
    for (unsigned i = 0; i < 40; i++)
        TEST_ASSERT_EQUAL_HEX8(0, ASK(0x31, 1, 0xF0, 0, 0, 0, 0, i % 2));
}

TEST(while_it_works_it_is_busy)
{
    uint8_t request[8 + IMAGE_HEADER] = {0x31, 1, 0xFF, 0};

    unlock();
    memcpy(&request[8], image.bytes, IMAGE_HEADER);
    answered = uds_serve(&uds, request, sizeof request, answer);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x7F, 0x31, 0x78}), answer, 3);
    answered = uds_serve(&uds, (uint8_t[]){0x3E, 0}, 2, answer);
    TEST_ASSERT_EQUAL_UINT16(0, answered);
    answered = uds_serve(&uds, (uint8_t[]){0x10, 2}, 2, answer);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x7F, 0x10, 0x21}), answer, 3);
    TEST_ASSERT_EQUAL(WORK_ERASE, uds.work);
    uds_pass(&uds, 10 * UDS_SESSION_MS, false);
    TEST_ASSERT_TRUE(uds.unlocked);
}
