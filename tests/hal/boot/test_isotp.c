#include "hal/boot/isotp.h"

#include <string.h>

#include "tests/test.h"

enum { ID = 0x61 };

static struct isotp isotp;
static struct frame sent;
static uint32_t now_ms;

void setUp(void)
{
    isotp = (struct isotp){.id = ID};
    now_ms = 1000;
}

static uint16_t take(const uint8_t *bytes, uint8_t len)
{
    struct frame frame = {.id = 1, .len = len};

    memcpy(frame.data, bytes, len);
    return isotp_take(&isotp, &frame, now_ms);
}

#define TAKE(...) take((const uint8_t[]){__VA_ARGS__}, sizeof (const uint8_t[]){__VA_ARGS__})

static bool next(void)
{
    if (!isotp_next(&isotp, &sent, now_ms))
        return false;
    TEST_ASSERT_EQUAL_HEX32(ID, sent.id);
    TEST_ASSERT_EQUAL_UINT8(8, sent.len);
    isotp_sent(&isotp, now_ms);
    return true;
}

static void send(uint16_t len)
{
    for (unsigned i = 0; i < ISOTP_TX_MAX; i++)
        isotp.tx[i] = (uint8_t)(i + 1);
    isotp_send(&isotp, len);
}

/* A message of len bytes, up to its last frame but one. */
static void begin_message(uint16_t len)
{
    TEST_ASSERT_EQUAL_UINT16(0, TAKE((uint8_t)(0x10 | len >> 8), (uint8_t)len, 0, 1, 2, 3, 4, 5));
    TEST_ASSERT_TRUE(isotp_busy(&isotp));
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x30, 0, 0, 0xCC, 0xCC, 0xCC, 0xCC, 0xCC}), sent.data, 8);
}

TEST(a_single_frame_is_a_message)
{
    TEST_ASSERT_EQUAL_UINT16(2, TAKE(2, 0x3E, 0, 0xCC));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x3E, 0}), isotp.rx, 2);
    TEST_ASSERT_EQUAL_UINT16(7, TAKE(7, 1, 2, 3, 4, 5, 6, 7));
}

TEST(what_is_no_single_frame_is_none)
{
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0, 1));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(2, 1));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(8, 1, 2, 3, 4, 5, 6, 7));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(1));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x40, 1, 2));
    TEST_ASSERT_FALSE(isotp_busy(&isotp));
}

TEST(a_long_message_comes_in_frames)
{
    begin_message(20);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21, 6, 7, 8, 9, 10, 11, 12));
    TEST_ASSERT_EQUAL_UINT16(20, TAKE(0x22, 13, 14, 15, 16, 17, 18, 19));
    for (unsigned i = 0; i < 20; i++)
        TEST_ASSERT_EQUAL_HEX8(i, isotp.rx[i]);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x23, 13, 14, 15, 16, 17, 18, 19));
}

TEST(the_longest_message_comes_whole_and_its_numbers_go_round)
{
    uint16_t got = 0;

    begin_message(ISOTP_RX_MAX);
    for (unsigned at = 6, number = 1; at < ISOTP_RX_MAX; at += 7, number++) {
        TEST_ASSERT_EQUAL_UINT16(0, got);
        got = TAKE((uint8_t)(0x20 | (number & 15)), 1, 2, 3, 4, 5, 6, 7);
    }
    TEST_ASSERT_EQUAL_UINT16(ISOTP_RX_MAX, got);
}

TEST(a_message_that_is_too_long_is_refused)
{
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x14, 3, 0, 0, 0, 0, 0, 0));
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8(0x32, sent.data[0]);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21, 1, 2, 3, 4, 5, 6, 7));
}

TEST(a_first_frame_that_is_short_or_unneeded_is_left_out)
{
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x10, 20, 0, 1, 2, 3, 4));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x10, 7, 0, 1, 2, 3, 4, 5));
    TEST_ASSERT_FALSE(isotp_busy(&isotp));
}

TEST(a_frame_that_is_missing_ends_the_message)
{
    begin_message(20);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x22, 6, 7, 8, 9, 10, 11, 12));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21, 6, 7, 8, 9, 10, 11, 12));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x22, 6, 7, 8, 9, 10, 11, 12));
    begin_message(20);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21, 6, 7, 8, 9, 10, 11));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21, 6, 7, 8, 9, 10, 11, 12));
}

TEST(a_message_that_does_not_go_on_is_forgotten)
{
    begin_message(13);
    now_ms += ISOTP_TIMEOUT_MS;
    TEST_ASSERT_EQUAL_UINT16(13, TAKE(0x21, 6, 7, 8, 9, 10, 11, 12));
    begin_message(13);
    now_ms += ISOTP_TIMEOUT_MS + 1;
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21, 6, 7, 8, 9, 10, 11, 12));
}

TEST(a_single_frame_takes_the_place_of_a_message)
{
    begin_message(20);
    TEST_ASSERT_EQUAL_UINT16(1, TAKE(1, 9));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21, 6, 7, 8, 9, 10, 11, 12));
}

TEST(a_short_answer_is_one_frame)
{
    send(7);
    TEST_ASSERT_TRUE(isotp_busy(&isotp));
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){7, 1, 2, 3, 4, 5, 6, 7}), sent.data, 8);
    TEST_ASSERT_FALSE(isotp_busy(&isotp));
    TEST_ASSERT_FALSE(next());
}

TEST(a_flow_control_that_nobody_waits_for_changes_nothing)
{
    send(7);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x32, 0, 0));
    TEST_ASSERT_TRUE(next());
}

static void begin_sending(uint16_t len)
{
    send(len);
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x10, (uint8_t)len, 1, 2, 3, 4, 5, 6}), sent.data, 8);
    TEST_ASSERT_FALSE(next());
}

TEST(a_long_answer_waits_for_its_flow_control)
{
    begin_sending(15);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x30, 0, 0));
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x21, 7, 8, 9, 10, 11, 12, 13}), sent.data, 8);
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x22, 14, 15, 0xCC, 0xCC, 0xCC, 0xCC, 0xCC}), sent.data, 8);
    TEST_ASSERT_FALSE(isotp_busy(&isotp));
}

TEST(after_a_block_it_waits_again)
{
    begin_sending(40);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x30, 2, 0));
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_FALSE(next());
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x30, 0, 0));
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_TRUE(next());
    TEST_ASSERT_FALSE(isotp_busy(&isotp));
}

TEST(frames_keep_the_gap_that_was_asked_for)
{
    static const struct {
        uint8_t code, gap_ms;
    } gaps[] = {{0, 0}, {5, 5}, {0x7F, 127}, {0xF1, 1}, {0xF9, 1}, {0xF0, 127}, {0xFA, 127}, {0x80, 127}};

    for (unsigned i = 0; i < sizeof gaps / sizeof gaps[0]; i++) {
        begin_sending(20);
        TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x30, 0, gaps[i].code));
        now_ms += gaps[i].gap_ms;
        TEST_ASSERT_TRUE(next());
        if (gaps[i].gap_ms > 0) {
            now_ms += gaps[i].gap_ms - 1u;
            TEST_ASSERT_FALSE(next());
            now_ms++;
        }
        TEST_ASSERT_TRUE(next());
    }
}

TEST(who_asks_it_to_wait_is_waited_for_and_who_overflows_is_left_alone)
{
    begin_sending(20);
    now_ms += ISOTP_TIMEOUT_MS;
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x31, 0, 0));
    now_ms += ISOTP_TIMEOUT_MS;
    TEST_ASSERT_FALSE(next());
    TEST_ASSERT_TRUE(isotp_busy(&isotp));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x32, 0, 0));
    TEST_ASSERT_FALSE(isotp_busy(&isotp));
}

TEST(an_answer_that_nobody_wants_is_given_up)
{
    begin_sending(20);
    now_ms += ISOTP_TIMEOUT_MS + 1;
    TEST_ASSERT_FALSE(next());
    TEST_ASSERT_FALSE(isotp_busy(&isotp));
    begin_sending(20);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x30, 0));
    TEST_ASSERT_FALSE(next());
    TEST_ASSERT_TRUE(isotp_busy(&isotp));
}

TEST(a_gap_that_was_asked_for_is_not_kept_by_the_next_answer)
{
    send(20);
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x30, 0, 0x7F));
    send(20);
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8(0x10, sent.data[0]);
    TEST_ASSERT_EQUAL_HEX8(20, sent.data[1]);
}

TEST(a_flow_control_goes_out_once_and_before_an_answer)
{
    send(2);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x10, 9, 0, 1, 2, 3, 4, 5));
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8(0x30, sent.data[0]);
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8(2, sent.data[0]);
    TEST_ASSERT_FALSE(next());
}

TEST(each_frame_of_a_message_gives_it_time)
{
    begin_message(30);
    for (uint8_t number = 1; number <= 3; number++) {
        now_ms += ISOTP_TIMEOUT_MS;
        TEST_ASSERT_EQUAL_UINT16(0, TAKE((uint8_t)(0x20 | number), 1, 2, 3, 4, 5, 6, 7));
    }
    now_ms += ISOTP_TIMEOUT_MS;
    TEST_ASSERT_EQUAL_UINT16(30, TAKE(0x24, 1, 2, 3));
}

TEST(an_empty_frame_or_one_without_its_length_ends_no_message)
{
    begin_message(13);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0, 1));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(3, 1));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x10, 6, 1, 2, 3, 4, 5, 6));
    TEST_ASSERT_EQUAL_UINT16(13, TAKE(0x21, 6, 7, 8, 9, 10, 11, 12));
}

TEST(what_a_single_frame_interrupts_does_not_go_on)
{
    TEST_ASSERT_EQUAL_UINT16(2, TAKE(2, 0x3E, 0));
    TEST_ASSERT_FALSE(isotp_receives(&isotp, now_ms));
    begin_message(13);
    TEST_ASSERT_EQUAL_UINT16(2, TAKE(2, 0x3E, 0));
    TEST_ASSERT_FALSE(isotp_receives(&isotp, now_ms));
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21, 6, 7, 8, 9, 10, 11, 12));
}

TEST(eight_bytes_are_the_shortest_long_message_both_ways)
{
    begin_message(8);
    TEST_ASSERT_TRUE(isotp_receives(&isotp, now_ms));
    TEST_ASSERT_EQUAL_UINT16(8, TAKE(0x21, 6, 7));
    TEST_ASSERT_FALSE(isotp_receives(&isotp, now_ms));
    send(8);
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x10, 8, 1, 2}), sent.data, 4);
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x30, 0, 0, 0xCC, 0xCC, 0xCC, 0xCC, 0xCC));
    TEST_ASSERT_TRUE(next());
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x21, 7, 8, 0xCC}), sent.data, 4);
}

TEST(a_frame_of_another_number_or_too_few_bytes_ends_the_message)
{
    static const uint8_t wrong[][8] = {{0x20, 6, 7, 8, 9, 10, 11, 12}, {0x22, 6, 7, 8, 9, 10, 11, 12}, {0x21, 6}, {0x21, 6}};
    static const uint8_t lens[] = {8, 8, 7, 3};

    for (unsigned i = 0; i < sizeof lens; i++) {
        begin_message(13);
        TEST_ASSERT_EQUAL_UINT16(0, take(wrong[i], lens[i]));
        TEST_ASSERT_FALSE(isotp_receives(&isotp, now_ms));
        TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x21, 6, 7, 8, 9, 10, 11, 12));
    }
}

TEST(of_a_message_that_is_too_long_nothing_is_awaited_and_no_answer_is)
{
    TEST_ASSERT_EQUAL_UINT16(0, TAKE(0x14, 3, 0, 1, 2, 3, 4, 5));
    TEST_ASSERT_FALSE(isotp_receives(&isotp, now_ms));
    isotp_send(&isotp, ISOTP_TX_MAX + 1);
    TEST_ASSERT_EQUAL_UINT16(ISOTP_TX_MAX, isotp.tx_len);
}
