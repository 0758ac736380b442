/* The blocks of a download: what comes of them is written as it comes. */
#include "hal/boot/uds.h"

#include <string.h>

#include "tests/test.h"

#include "tester.h"

static struct signed_image image;

void setUp(void)
{
    image = tester_begin();
}

TEST(one_that_was_cut_short_is_not_chosen)
{
    begin_download(&image);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x36, 1, 'O', 'C', 'T', 'E'));
    TEST_ASSERT_EQUAL_HEX8(0x24, ASK(0x37));
    TEST_ASSERT_EQUAL_HEX8(0x24, check());
}

TEST(a_download_is_of_what_was_announced)
{
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0x13, ASK(0x34, 0, 0x44, 0));
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x34, 1, 0x44, 0, 0, 0, 0, 0, 0, SIGNED_BYTES >> 8, SIGNED_BYTES & 0xFF));
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x34, 0, 0x33, 0, 0, 0, 0, 0, 0, SIGNED_BYTES >> 8, SIGNED_BYTES & 0xFF));
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x34, 0, 0x44, 0, 0, 1, 0, 0, 0, SIGNED_BYTES >> 8, SIGNED_BYTES & 0xFF));
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x34, 0, 0x44, 0, 0, 0, 0, 0, 0, SIGNED_BYTES >> 8, (SIGNED_BYTES & 0xFF) - 1));
    TEST_ASSERT_EQUAL_HEX8(0, download(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0x13, ASK(0x37, 0));
}

TEST(a_block_that_comes_again_is_written_once_and_one_that_is_missing_is_noticed)
{
    begin_download(&image);
    TEST_ASSERT_EQUAL_HEX8(0x73, ASK(0x36, 0, 'O', 'C', 'T', 'E'));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x36, 1, 'O', 'C', 'T', 'E'));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x36, 1, 'O', 'C', 'T', 'E'));
    TEST_ASSERT_EQUAL_HEX8(0x73, ASK(0x36, 3, 'O', 'C', 'T', 'E'));
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x36, 2, 1, 2));
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x36, 2));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x36, 2, 'T', 'I', 'M', 'G'));
    TEST_ASSERT_EQUAL_HEX8(0x73, ASK(0x36, 1, 'O', 'C', 'T', 'E'));
    TEST_ASSERT_EQUAL_HEX8(0x24, download(&image, 0));
    TEST_ASSERT_EQUAL_MEMORY("OCTETIMG\xFF", boot_flash_slot(1), 9);
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, announce(0));
    TEST_ASSERT_EQUAL_HEX8(0x73, ASK(0x36, 0, 'O', 'C', 'T', 'E'));
}

TEST(what_has_come_of_a_block_is_written_while_the_rest_comes)
{
    static const uint8_t block[] = {0x36, 1, 'O', 'C', 'T', 'E', 'T', 'I', 'M', 'G'};
    unsigned before;

    begin_download(&image);
    before = boot_flash.operations;
    TEST_ASSERT_FALSE(uds_ahead(&uds, block, 5));
    TEST_ASSERT_TRUE(uds_ahead(&uds, block, 6));
    TEST_ASSERT_EQUAL_MEMORY("OCTE\xFF", boot_flash_slot(1), 5);
    TEST_ASSERT_FALSE(uds_ahead(&uds, block, 9));
    TEST_ASSERT_TRUE(uds_ahead(&uds, block, 10));
    TEST_ASSERT_EQUAL_HEX8(0, ask(block, sizeof block));
    TEST_ASSERT_EQUAL_MEMORY("OCTETIMG\xFF", boot_flash_slot(1), 9);
    TEST_ASSERT_EQUAL_UINT(before + 4, boot_flash.operations);
}

TEST(a_block_that_was_cut_short_comes_again_even_as_shorter_ones)
{
    uint8_t block[2 + SIGNED_BYTES] = {0x36, 1};

    begin_download(&image);
    memcpy(&block[2], image.bytes, SIGNED_BYTES);
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_TRUE(uds_ahead(&uds, block, sizeof block));
    TEST_ASSERT_EQUAL_HEX8(0, ask(block, 2 + 8));
    block[1] = 2;
    memcpy(&block[2], &image.bytes[8], SIGNED_BYTES - 8);
    TEST_ASSERT_TRUE(uds_ahead(&uds, block, 2 + 8));
    TEST_ASSERT_EQUAL_HEX8(0, ask(block, sizeof block - 8));
    TEST_ASSERT_EQUAL_MEMORY(image.bytes, boot_flash_slot(1), SIGNED_BYTES);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x37));
    TEST_ASSERT_EQUAL_HEX8(0, check());
}

TEST(nothing_but_the_block_that_is_due_is_written_ahead)
{
    uint8_t block[2 + SIGNED_BYTES + 4] = {0x36, 1};

    TEST_ASSERT_FALSE(uds_ahead(&uds, block, sizeof block));
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_FALSE(uds_ahead(&uds, block, sizeof block));
    begin_download(&image);
    block[1] = 2;
    TEST_ASSERT_FALSE(uds_ahead(&uds, block, sizeof block));
    block[0] = 0x31;
    block[1] = 1;
    TEST_ASSERT_FALSE(uds_ahead(&uds, block, sizeof block));
    block[0] = 0x36;
    for (unsigned i = 0; i < SIGNED_BYTES / 4; i++)
        TEST_ASSERT_TRUE(uds_ahead(&uds, block, sizeof block));
    TEST_ASSERT_FALSE(uds_ahead(&uds, block, sizeof block));
    TEST_ASSERT_EQUAL_HEX8(0x31, ask(block, sizeof block));
    TEST_ASSERT_EQUAL_HEX8(0, ask(block, 2 + 4));
    TEST_ASSERT_EQUAL_HEX8(0, ask((uint8_t[]){0x36, 2, 0, 0, 0, 0}, 2 + 4));
    TEST_ASSERT_FALSE(uds_ahead(&uds, block, sizeof block));
    begin_download(&image);
    TEST_ASSERT_EQUAL_HEX8(0, ask(block, 2 + 4));
    TEST_ASSERT_FALSE(uds_ahead(&uds, block, sizeof block));
    block[1] = 2;
    for (unsigned i = 1; i < SIGNED_BYTES / 4; i++)
        TEST_ASSERT_TRUE(uds_ahead(&uds, block, sizeof block));
    TEST_ASSERT_FALSE(uds_ahead(&uds, block, sizeof block));
    TEST_ASSERT_EQUAL_HEX8(0x31, ask(block, 2 + SIGNED_BYTES));
}

TEST(an_erase_forgets_what_was_written_ahead)
{
    static const uint8_t block[] = {0x36, 1, 1, 2, 3, 4};

    begin_download(&image);
    TEST_ASSERT_TRUE(uds_ahead(&uds, block, sizeof block));
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, download(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, check());
}

TEST(a_request_whose_answer_was_lost_can_come_again)
{
    begin_download(&image);
    TEST_ASSERT_EQUAL_HEX8(0, download(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x37));
    TEST_ASSERT_EQUAL_HEX8(0, check());
    TEST_ASSERT_EQUAL_HEX8(0x24, ASK(0x37));
}

TEST(no_block_goes_beyond_the_end)
{
    uint8_t block[2 + SIGNED_BYTES + 4] = {0x36, 1};

    unlock();
    TEST_ASSERT_EQUAL_HEX8(0x31, erase_for(&image, PAGE));   /* nothing is written there yet */
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, announce(0));
    TEST_ASSERT_EQUAL_HEX8(0x31, ask(block, sizeof block));
}
