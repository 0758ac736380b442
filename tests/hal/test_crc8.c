#include "hal/protocol/crc8.h"

#include <unity.h>

static struct frame frame;

void setUp(void)
{
    frame = (struct frame){.id = 0x0C1, .len = 8, .data = {0, 0x34, 0x12, 0xFF, 0x00, 0xA5, 0x5A, 0x81}};
    frame.data[0] = crc8_of_frame(&frame);
}

void tearDown(void) {}

/* The catalogue of CRCs has 0x4B for "123456789": here two digits in the identifier, seven in the data. */
static void test_the_published_check_value(void)
{
    frame = (struct frame){.id = '1' | '2' << 8, .len = 8, .data = {0, '3', '4', '5', '6', '7', '8', '9'}};
    TEST_ASSERT_EQUAL_HEX8(0x4B, crc8_of_frame(&frame));
}

static void test_byte_0_where_the_crc_is_kept_is_not_covered(void)
{
    const uint8_t crc = frame.data[0];

    for (unsigned value = 0; value <= UINT8_MAX; value++) {
        frame.data[0] = (uint8_t)value;
        TEST_ASSERT_EQUAL_HEX8(crc, crc8_of_frame(&frame));
    }
}

static void test_bytes_beyond_the_length_are_not_covered(void)
{
    uint8_t crc;

    frame.len = 3;
    crc = crc8_of_frame(&frame);
    frame.data[3] ^= 0xFF;
    TEST_ASSERT_EQUAL_HEX8(crc, crc8_of_frame(&frame));
}

static void test_a_frame_sent_to_the_next_node_has_another_crc(void)
{
    frame.id++;
    TEST_ASSERT_TRUE(crc8_of_frame(&frame) != frame.data[0]);
}

static void flip(unsigned bit)
{
    enum { ID_BITS = 11 };

    if (bit < ID_BITS)
        frame.id ^= 1u << bit;
    else
        frame.data[(bit - ID_BITS) / 8] ^= (uint8_t)(1u << (bit - ID_BITS) % 8);
}

static void assert_found(void)
{
    TEST_ASSERT_TRUE(crc8_of_frame(&frame) != frame.data[0]);
}

static void test_every_flip_of_one_or_two_bits_is_found(void)
{
    enum { BITS = 11 + 64 };

    for (unsigned i = 0; i < BITS; i++) {
        flip(i);
        assert_found();
        for (unsigned j = 0; j < i; j++) {
            flip(j);
            assert_found();
            flip(j);
        }
        flip(i);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_published_check_value);
    RUN_TEST(test_byte_0_where_the_crc_is_kept_is_not_covered);
    RUN_TEST(test_bytes_beyond_the_length_are_not_covered);
    RUN_TEST(test_a_frame_sent_to_the_next_node_has_another_crc);
    RUN_TEST(test_every_flip_of_one_or_two_bits_is_found);
    return UNITY_END();
}
