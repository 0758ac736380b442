#include "hal/flash_store/crc32.h"

#include <string.h>

#include "tests/test.h"

static uint32_t crc_of(const char *text)
{
    return crc32((const uint8_t *)text, strlen(text));
}

/* The check value of CRC-32/ISO-HDLC in the catalogue of parametrised CRC algorithms; zlib's crc32 gives all of these. */
TEST(known_bytes_have_their_known_crc)
{
    TEST_ASSERT_EQUAL_HEX32(0xCBF43926, crc_of("123456789"));
    TEST_ASSERT_EQUAL_HEX32(0x00000000, crc_of(""));
    TEST_ASSERT_EQUAL_HEX32(0xE8B7BE43, crc_of("a"));
    TEST_ASSERT_EQUAL_HEX32(0x414FA339, crc_of("The quick brown fox jumps over the lazy dog"));
}

TEST(zeros_and_ones_count)
{
    static const uint8_t zeros[4] = {0, 0, 0, 0}, ones[4] = {0xFF, 0xFF, 0xFF, 0xFF};

    TEST_ASSERT_EQUAL_HEX32(0x2144DF1C, crc32(zeros, sizeof zeros));
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFFFF, crc32(ones, sizeof ones));
}

TEST(the_count_is_kept_to)
{
    static const uint8_t bytes[3] = {'a', 'b', 'c'};

    TEST_ASSERT_EQUAL_HEX32(0xE8B7BE43, crc32(bytes, 1));
    TEST_ASSERT_EQUAL_HEX32(0x352441C2, crc32(bytes, 3));
}
