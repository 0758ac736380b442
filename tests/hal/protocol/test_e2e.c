#include "hal/protocol/e2e.h"
#include "tests/test.h"

static struct frame frame;

void setUp(void)
{
    frame = (struct frame){.id = 0x101, .len = 8, .data = {0, 0x34, 0x12, 0xFF, 0x00, 0xA5, 0x5A, 0x81}};
    e2e_protect(&frame);
}

static uint8_t crc_of(struct frame some)
{
    e2e_protect(&some);
    return some.data[0];
}

/* From the AUTOSAR specification of E2E profile 1, with its Data ID 0x0123: eight bytes 0, counter 0. */
TEST(crc_equals_the_published_example)
{
    frame = (struct frame){.id = 0x123, .len = 8};
    TEST_ASSERT_EQUAL_HEX8(0xCC, crc_of(frame));
}

/* The catalogue of CRCs has 0x37 for "123456789" with this polynomial from 0 to 0: here two digits in the identifier. */
TEST(crc_equals_the_published_check_value)
{
    frame = (struct frame){.id = '1' | '2' << 8, .len = 8, .data = {0, '3', '4', '5', '6', '7', '8', '9'}};
    TEST_ASSERT_EQUAL_HEX8(0x37, crc_of(frame));
}

TEST(crc_does_not_cover_byte_0)
{
    const uint8_t crc = frame.data[0];

    for (unsigned value = 0; value <= UINT8_MAX; value++) {
        frame.data[0] = (uint8_t)value;
        TEST_ASSERT_EQUAL_HEX8(crc, crc_of(frame));
    }
}

TEST(crc_does_not_cover_bytes_beyond_the_length)
{
    uint8_t crc;

    frame.len = 3;
    crc = crc_of(frame);
    frame.data[3] ^= 0xFF;
    TEST_ASSERT_EQUAL_HEX8(crc, crc_of(frame));
}

TEST(frame_for_the_next_node_is_not_whole)
{
    frame.id++;
    TEST_ASSERT_FALSE(e2e_is_whole(&frame, 8));
}

TEST(frame_of_wrong_length_is_not_whole)
{
    for (uint8_t len = 0; len < 8; len++)
        TEST_ASSERT_FALSE(e2e_is_whole(&frame, len));
    TEST_ASSERT_TRUE(e2e_is_whole(&frame, 8));
}

TEST(shorter_frame_with_valid_crc_is_not_whole)
{
    for (frame.len = 2; frame.len < 8; frame.len++) {
        e2e_protect(&frame);
        TEST_ASSERT_FALSE(e2e_is_whole(&frame, 8));
        TEST_ASSERT_TRUE(e2e_is_whole(&frame, frame.len));
    }
}

TEST(counter_15_is_invalid)
{
    frame.data[1] |= 15;
    e2e_protect(&frame);
    TEST_ASSERT_FALSE(e2e_is_whole(&frame, 8));
}

enum { ID_BITS = 11, BITS = ID_BITS + 64 };

static void flip(unsigned bit)
{
    if (bit < ID_BITS)
        frame.id ^= 1u << bit;
    else
        frame.data[(bit - ID_BITS) / 8] ^= (uint8_t)(1u << (bit - ID_BITS) % 8);
}

/* Flips that many bits, each below the last one, in every way; returns how many of the frames pass for whole. */
static unsigned passes_with_flips_below(unsigned last, unsigned count)
{
    unsigned passed = 0;

    if (count == 0)
        return e2e_is_whole(&frame, 8);
    for (unsigned bit = 0; bit < last; bit++) {
        flip(bit);
        passed += passes_with_flips_below(bit, count - 1);
        flip(bit);
    }
    return passed;
}

TEST(crc_detects_every_flip_of_one_or_two_bits)
{
    TEST_ASSERT_EQUAL_UINT(0, passes_with_flips_below(BITS, 1));
    TEST_ASSERT_EQUAL_UINT(0, passes_with_flips_below(BITS, 2));
    TEST_ASSERT_TRUE(e2e_is_whole(&frame, 8));   /* the clean control */
}

/* Eight bits of CRC cannot find all of them. */
TEST(crc_misses_296_of_67525_three_bit_flips)
{
    TEST_ASSERT_EQUAL_UINT(296, passes_with_flips_below(BITS, 3));
}

TEST(counters_wrap_after_14)
{
    uint8_t counter = 0;

    for (unsigned i = 1; i <= 30; i++) {
        counter = e2e_next(counter);
        TEST_ASSERT_EQUAL_UINT8(i % 15, counter);
    }
}

TEST(e2e_ahead_counts_steps_between_counters)
{
    for (uint8_t from = 0; from < E2E_COUNTERS; from++) {
        uint8_t to = from;

        for (unsigned steps = 0; steps < E2E_COUNTERS; steps++) {
            TEST_ASSERT_EQUAL_UINT(steps, e2e_ahead(from, to));
            to = e2e_next(to);
        }
    }
}
