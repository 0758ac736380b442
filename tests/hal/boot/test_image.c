#include "hal/boot/image.h"

#include <string.h>

#include "hal/flash_store/crc32.h"
#include "tests/test.h"

#include "signer.h"

static struct image found;

void setUp(void)
{
    boot_flash_clear();
    found = (struct image){0};
}

static void put(const struct signed_image *image, unsigned slot)
{
    memcpy(boot_flash_slot(slot), image->bytes, sizeof image->bytes);
}

TEST(a_signature_of_the_standard_holds_and_a_changed_one_does_not)
{
    uint8_t signature[IMAGE_SIGNATURE] = {
        0x62, 0x91, 0xD6, 0x57, 0xDE, 0xEC, 0x24, 0x02, 0x48, 0x27, 0xE6, 0x9C, 0x3A, 0xBE, 0x01, 0xA3,
        0x0C, 0xE5, 0x48, 0xA2, 0x84, 0x74, 0x3A, 0x44, 0x5E, 0x36, 0x80, 0xD7, 0xDB, 0x5A, 0xC3, 0xAC,
        0x18, 0xFF, 0x9B, 0x53, 0x8D, 0x16, 0xF2, 0x90, 0xAE, 0x67, 0xF7, 0x60, 0x98, 0x4D, 0xC6, 0x59,
        0x4A, 0x7C, 0x15, 0xE9, 0x71, 0x6E, 0xD2, 0x8D, 0xC0, 0x27, 0xBE, 0xCE, 0xEA, 0x1E, 0xC4, 0x0A,
    };
    static const uint8_t text[] = {0xAF, 0x82};

    TEST_ASSERT_TRUE(image_proves(signature, text, sizeof text));
    TEST_ASSERT_FALSE(image_proves(signature, text, 1));
    for (unsigned at = 0; at < IMAGE_SIGNATURE; at++) {
        signature[at] ^= 0x10;
        TEST_ASSERT_FALSE(image_proves(signature, text, sizeof text));
        signature[at] ^= 0x10;
    }
}

TEST(a_signed_image_is_taken_in_the_slot_that_it_was_made_for)
{
    signer_put(0, 5);
    signer_put(1, 6);
    for (unsigned slot = 0; slot < SLOTS; slot++) {
        TEST_ASSERT_EQUAL(REFUSAL_NONE, image_verify(slot, &found));
        TEST_ASSERT_EQUAL_UINT32(5 + slot, found.version);
        TEST_ASSERT_EQUAL_UINT32(SIGNED_BYTES - IMAGE_SIGNATURE, found.size);
    }
}

TEST(an_image_that_starts_may_be_as_old_as_it_likes)
{
    signer_put(0, 0);
    TEST_ASSERT_EQUAL(REFUSAL_NONE, image_check(0, &found));
}

TEST(one_wrong_bit_anywhere_is_found)
{
    signer_put(0, 5);
    for (unsigned at = 0; at < SIGNED_BYTES; at++) {
        boot_flash_slot(0)[at] ^= (uint8_t)(1u << at % 8);
        TEST_ASSERT_NOT_EQUAL_INT(REFUSAL_NONE, image_verify(0, &found));
        boot_flash_slot(0)[at] ^= (uint8_t)(1u << at % 8);
    }
    TEST_ASSERT_EQUAL(REFUSAL_NONE, image_verify(0, &found));
}

TEST(another_signer_is_found_where_the_crc_fits)
{
    struct signed_image image = signer_image(0, 5);

    image.bytes[SIGNED_BYTES - 1] ^= 1;
    put(&image, 0);
    TEST_ASSERT_EQUAL(REFUSAL_NONE, image_check(0, &found));
    TEST_ASSERT_EQUAL(REFUSAL_SIGNATURE, image_verify(0, &found));
}

TEST(each_field_of_a_header_is_judged)
{
    static const struct {
        unsigned at;
        uint8_t value;
        enum refusal why;
    } wrong[] = {
        {0, 'o', REFUSAL_MAGIC}, {7, 'H', REFUSAL_MAGIC}, {20, 2, REFUSAL_MAGIC}, {24, 'S', REFUSAL_CHIP}, {33, '2', REFUSAL_CHIP},
        {35, 'x', REFUSAL_CHIP}, {9, 0, REFUSAL_SIZE},
        {36, 'T', REFUSAL_BOARD}, {46, 'x', REFUSAL_BOARD}, {63, 'x', REFUSAL_BOARD}, {22, 8, REFUSAL_LAYOUT},
        {21, 1, REFUSAL_SLOT}, {8, 65, REFUSAL_SIZE}, {10, 1, REFUSAL_SIZE}, {11, 0x80, REFUSAL_SIZE}, {16, 4, REFUSAL_OLDER},
    };
    struct signed_image image;

    for (unsigned i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        image = signer_image(0, 5);
        TEST_ASSERT_EQUAL(REFUSAL_NONE, image_judge(image.bytes, 0, 5, &found));
        image.bytes[wrong[i].at] = wrong[i].value;
        TEST_ASSERT_EQUAL_MESSAGE(wrong[i].why, image_judge(image.bytes, 0, 5, &found), "at its place");
    }
}

TEST(an_image_fills_its_slot_at_most)
{
    struct signed_image image = signer_image(0, 5);
    uint32_t most = SLOT_BYTES - IMAGE_SIGNATURE;

    image.bytes[8] = (uint8_t)most;
    image.bytes[9] = (uint8_t)(most >> 8);
    TEST_ASSERT_EQUAL(REFUSAL_NONE, image_judge(image.bytes, 0, 0, &found));
    image.bytes[8] = (uint8_t)(most + 64);
    image.bytes[9] = (uint8_t)((most + 64) >> 8);
    TEST_ASSERT_EQUAL(REFUSAL_SIZE, image_judge(image.bytes, 0, 0, &found));
    image.bytes[8] = 0;
    image.bytes[9] = IMAGE_VECTORS >> 8;
    TEST_ASSERT_EQUAL(REFUSAL_SIZE, image_judge(image.bytes, 0, 0, &found));
}

TEST(what_cannot_be_read_is_damaged)
{
    signer_put(0, 5);
    for (unsigned page = 0; page < 3; page++) {
        boot_flash.unreadable = SLOT_A + page;
        TEST_ASSERT_EQUAL(REFUSAL_DAMAGED, image_check(0, &found));
        TEST_ASSERT_EQUAL(REFUSAL_DAMAGED, image_verify(0, &found));
    }
    boot_flash.unreadable = SLOT_A;
    TEST_ASSERT_EQUAL_UINT32(0, image_version(0));
}

TEST(a_signature_on_a_page_that_cannot_be_read_is_damaged)
{
    struct signed_image image = signer_image(0, 5);
    uint32_t crc;

    image.bytes[8] = 0;
    image.bytes[9] = 2 * PAGE >> 8;
    crc = crc32_more(0, &image.bytes[16], 2 * PAGE - 16);
    for (unsigned i = 0; i < 4; i++)
        image.bytes[12 + i] = (uint8_t)(crc >> 8 * i);
    put(&image, 0);
    TEST_ASSERT_EQUAL(REFUSAL_SIGNATURE, image_verify(0, &found));
    boot_flash.unreadable = SLOT_A + 2;
    TEST_ASSERT_EQUAL(REFUSAL_DAMAGED, image_verify(0, &found));
}

TEST(what_is_written_are_whole_pages_without_the_last)
{
    TEST_ASSERT_EQUAL_UINT32(0, image_written(0));
    boot_flash_slot(0)[5] = 0;
    TEST_ASSERT_EQUAL_UINT32(0, image_written(0));
    boot_flash_slot(0)[PAGE] = 0;
    TEST_ASSERT_EQUAL_UINT32(PAGE, image_written(0));
    boot_flash_slot(0)[2 * PAGE - 1] = 0;
    TEST_ASSERT_EQUAL_UINT32(PAGE, image_written(0));
    boot_flash_slot(0)[SLOT_BYTES - 1] = 0xFE;
    TEST_ASSERT_EQUAL_UINT32(SLOT_BYTES - PAGE, image_written(0));
    boot_flash.unreadable = SLOT_A;
    boot_flash_slot(0)[SLOT_BYTES - 1] = 0xFF;
    TEST_ASSERT_EQUAL_UINT32(PAGE, image_written(0));
    boot_flash.unreadable = SLOT_A + SLOT_PAGES - 1;
    TEST_ASSERT_EQUAL_UINT32(SLOT_BYTES - PAGE, image_written(0));
}

TEST(the_header_that_was_announced_is_the_one_that_came)
{
    struct signed_image image = signer_image(0, 5);

    put(&image, 0);
    TEST_ASSERT_TRUE(image_has_header(0, image.bytes));
    image.bytes[63] = 1;
    TEST_ASSERT_FALSE(image_has_header(0, image.bytes));
    boot_flash.unreadable = SLOT_A;
    TEST_ASSERT_FALSE(image_has_header(0, boot_flash_slot(0)));
}
