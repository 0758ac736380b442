/* The images' own memcpy, memset and memcmp, under other names: what they write, and that they write nothing else. */
#include <stdint.h>
#include <string.h>

#include "tests/test.h"

enum { LENGTHS = 20, OFFSETS = 5, BUFFER = 32, GUARD = 0xEE };

void *octet_memcpy(void *restrict to, const void *restrict from, size_t count);
void *octet_memset(void *to, int value, size_t count);
int octet_memcmp(const void *one, const void *other, size_t count);

static uint8_t buffer[BUFFER], source[BUFFER];

void setUp(void)
{
    for (unsigned i = 0; i < BUFFER; i++)
        source[i] = (uint8_t)(i + 1);
}

static void guard(void)
{
    for (unsigned i = 0; i < BUFFER; i++)
        buffer[i] = GUARD;
}

static void assert_guarded_but(unsigned offset, unsigned length)
{
    for (unsigned i = 0; i < BUFFER; i++)
        if (i < offset || i >= offset + length)
            TEST_ASSERT_EQUAL_HEX8(GUARD, buffer[i]);
}

TEST(memcmp_orders_by_the_first_differing_byte)
{
    static const uint8_t low[] = {1, 2, 3, 200}, high[] = {1, 2, 200, 3};

    for (unsigned length = 0; length <= 4; length++) {
        TEST_ASSERT_EQUAL(0, octet_memcmp(low, low, length));
        TEST_ASSERT_TRUE((octet_memcmp(low, high, length) < 0) == (length > 2));
        TEST_ASSERT_TRUE((octet_memcmp(high, low, length) > 0) == (length > 2));
    }
}

TEST(memcpy_copies_at_any_alignment)
{
    for (unsigned length = 0; length < LENGTHS; length++)
        for (unsigned offset = 0; offset < OFFSETS; offset++) {
            guard();
            TEST_ASSERT_EQUAL_PTR(buffer + offset, octet_memcpy(buffer + offset, source + 1, length));
            for (unsigned i = 0; i < length; i++)
                TEST_ASSERT_EQUAL_HEX8(i + 2, buffer[offset + i]);
            assert_guarded_but(offset, length);
        }
}

TEST(memset_fills_at_any_alignment)
{
    for (unsigned length = 0; length < LENGTHS; length++)
        for (unsigned offset = 0; offset < OFFSETS; offset++) {
            guard();
            TEST_ASSERT_EQUAL_PTR(buffer + offset, octet_memset(buffer + offset, 0x5A, length));
            for (unsigned i = 0; i < length; i++)
                TEST_ASSERT_EQUAL_HEX8(0x5A, buffer[offset + i]);
            assert_guarded_but(offset, length);
        }
}

TEST(memset_uses_the_low_byte_of_its_value)
{
    octet_memset(buffer, 0x1FF, 7);
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, buffer, 7);
    octet_memset(buffer, -128, 7);
    TEST_ASSERT_EACH_EQUAL_HEX8(0x80, buffer, 7);
}
