#include <string.h>

#include "tests/test.h"
#include "hal/link/slcan.h"

struct tally {
    unsigned frames, garbled;
    struct frame last;
};

static struct tally decode(const char *text)
{
    struct slcan_decoder decoder = {0};
    struct tally tally = {0};
    for (; *text != '\0'; text++) {
        enum slcan_found found = slcan_decode(&decoder, *text, &tally.last);
        tally.frames += found == SLCAN_FRAME;
        tally.garbled += found == SLCAN_GARBLED;
    }
    return tally;
}

static void assert_decodes(const char *text, const struct frame *expected)
{
    struct tally tally = decode(text);
    TEST_ASSERT_EQUAL_UINT_MESSAGE(1, tally.frames, text);
    TEST_ASSERT_EQUAL_UINT_MESSAGE(0, tally.garbled, text);
    TEST_ASSERT_EQUAL_HEX32_MESSAGE(expected->id, tally.last.id, text);
    TEST_ASSERT_EQUAL_UINT8_MESSAGE(expected->len, tally.last.len, text);
    TEST_ASSERT_EQUAL_HEX8_ARRAY_MESSAGE(expected->data, tally.last.data, 8, text);
}

static void assert_encodes(const char *expected, const struct frame *frame)
{
    char text[SLCAN_TEXT_MAX + 1] = {0};
    TEST_ASSERT_EQUAL_size_t(strlen(expected), slcan_encode(text, frame));
    TEST_ASSERT_EQUAL_STRING(expected, text);
}

/* The line alone, then with a good frame after it. */
static void assert_garbled_once(const char *line)
{
    char text[128];
    strcpy(text, line);
    TEST_ASSERT_EQUAL_UINT_MESSAGE(0, decode(text).frames, line);
    strcat(text, "t1230\r");
    struct tally tally = decode(text);
    TEST_ASSERT_EQUAL_UINT_MESSAGE(1, tally.garbled, line);
    TEST_ASSERT_EQUAL_UINT_MESSAGE(1, tally.frames, line);
}

TEST(data_line_is_decoded)
{
    assert_decodes("t1233AABBCC\r", &(struct frame){0x123, 3, {0xAA, 0xBB, 0xCC}});
    assert_decodes("t7FF0\r", &(struct frame){0x7FF, 0, {0}});
    assert_decodes("t00080123456789ABCDEF\r",
                   &(struct frame){0, 8, {0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF}});
}

TEST(hex_may_be_lower_case)
{
    assert_decodes("t7fa2abfF\r", &(struct frame){0x7FA, 2, {0xAB, 0xFF}});
}

TEST(extended_and_remote_lines_set_flags)
{
    assert_decodes("T1FFFFFFF1A5\r", &(struct frame){0x1FFFFFFF | FRAME_EXTENDED, 1, {0xA5}});
    assert_decodes("r1238\r", &(struct frame){0x123 | FRAME_REMOTE, 8, {0}});
    assert_decodes("R000001230\r", &(struct frame){0x123 | FRAME_EXTENDED | FRAME_REMOTE, 0, {0}});
}

TEST(timestamp_is_ignored)
{
    assert_decodes("t1231AAEA5F\r", &(struct frame){0x123, 1, {0xAA}});
    assert_decodes("r1231EA5F\r", &(struct frame){0x123 | FRAME_REMOTE, 1, {0}});
    assert_decodes("T0000012380011223344556677EA5F\r",
                   &(struct frame){0x123 | FRAME_EXTENDED, 8, {0, 0x11, 0x22, 0x33, 0x44, 0x55, 0x66, 0x77}});
}

TEST(replies_and_setup_commands_are_ignored)
{
    struct tally tally = decode("\r\r\az\rZ\rC\rS6\rO\rL\rY2\rs031C\rV\rN\rF\rZ1\rM00000000\rmFFFFFFFF\r");

    TEST_ASSERT_EQUAL_UINT(0, tally.frames);
    TEST_ASSERT_EQUAL_UINT(0, tally.garbled);
}

TEST(frame_after_setup_commands_is_decoded)
{
    assert_decodes("C\rS6\rO\r\at1230\r", &(struct frame){0x123, 0, {0}});
}

TEST(incomplete_line_is_garbled_once)
{
    assert_garbled_once("t\r");
    assert_garbled_once("t12\r");
    assert_garbled_once("t123\r");
    assert_garbled_once("t1232AA\r");
    assert_garbled_once("t1232AAB\r");
    assert_garbled_once("T0000012\r");
    assert_garbled_once("t1232A\a");
}

TEST(rest_of_a_cut_line_is_garbled_once)
{
    assert_garbled_once("3AABBCC\r");
    assert_garbled_once("CC11\r");
    assert_garbled_once("F0\r");
}

TEST(merged_lines_are_garbled_once)
{
    assert_garbled_once("t1232At1230\r");
}

TEST(overlong_line_is_garbled_once)
{
    assert_garbled_once("T0000012380011223344556677EA5F0\r");
    assert_garbled_once("t1230ttttttttttttttttttttttttttttttttttttttttttttttttttttttttttttttttttttttt\r");
}

TEST(line_of_any_length_is_garbled_once)
{
    struct slcan_decoder decoder = {0};
    struct frame frame;
    for (int len = 1; len < 600; len++) {
        for (int i = 0; i < len; i++) TEST_ASSERT_EQUAL(SLCAN_NOTHING, slcan_decode(&decoder, '0', &frame));
        TEST_ASSERT_EQUAL(SLCAN_GARBLED, slcan_decode(&decoder, '\r', &frame));
    }
}

TEST(timestamp_of_wrong_length_is_garbled)
{
    assert_garbled_once("t1231AAE\r");
    assert_garbled_once("t1231AAEA5\r");
    assert_garbled_once("t1231AAEA5F0\r");
}

/* The decoder still holds the longer line before it. */
TEST(cut_line_is_garbled_after_a_longer_line)
{
    static const char *const cut[] = {"t\r", "t12\r", "t123\r", "t12321\r", "t1232112\r", "t12300\r", "T1234567\r", "t1230012\r"};

    for (unsigned i = 0; i < sizeof cut / sizeof cut[0]; i++) {
        struct slcan_decoder decoder = {.len = 0};
        struct frame frame;

        for (const char *c = "T1234567881122334455667788AAAA\r"; *c != '\0'; c++)
            (void)slcan_decode(&decoder, *c, &frame);
        for (const char *c = cut[i]; *c != '\r'; c++)
            TEST_ASSERT_EQUAL(SLCAN_NOTHING, slcan_decode(&decoder, *c, &frame));
        TEST_ASSERT_EQUAL_MESSAGE(SLCAN_GARBLED, slcan_decode(&decoder, '\r', &frame), cut[i]);
    }
}

TEST(line_with_impossible_identifier_or_length_is_garbled)
{
    assert_garbled_once("t8000\r");
    assert_garbled_once("T200000000\r");
    assert_garbled_once("t1239001122334455667788\r");
    assert_garbled_once("t123G\r");
    assert_garbled_once("t1231A:\r");
    assert_garbled_once("t12/0\r");
    assert_garbled_once("t12@0\r");
    assert_garbled_once("t12`0\r");
    assert_garbled_once("t12g0\r");
    assert_garbled_once("r1239\r");
    assert_garbled_once("x1230\r");
    assert_garbled_once("\nt1230\r");
    assert_garbled_once("\x80\xFF\r");
}

TEST(garbled_line_leaves_the_frame_unchanged)
{
    struct tally tally = decode("t7FF1A5\rt1231\r");

    TEST_ASSERT_EQUAL_HEX32(0x7FF, tally.last.id);
    TEST_ASSERT_EQUAL_HEX8(0xA5, tally.last.data[0]);
}

TEST(frames_are_encoded_in_upper_case)
{
    assert_encodes("t7FA2ABFF\r", &(struct frame){0x7FA, 2, {0xAB, 0xFF}});
    assert_encodes("t0010\r", &(struct frame){0x001, 0, {0}});
    assert_encodes("T1ABCDEF01A5\r", &(struct frame){0x1ABCDEF0 | FRAME_EXTENDED, 1, {0xA5}});
    assert_encodes("r1238\r", &(struct frame){0x123 | FRAME_REMOTE, 8, {0}});
    assert_encodes("R000001232\r", &(struct frame){0x123 | FRAME_REMOTE | FRAME_EXTENDED, 2, {0}});
}

TEST(longest_line_fits)
{
    assert_encodes("T1FFFFFFF8FFFFFFFFFFFFFFFF\r",
                   &(struct frame){0xFFFFFFFF & ~FRAME_REMOTE, 8, {255, 255, 255, 255, 255, 255, 255, 255}});
}

TEST(encoded_line_decodes_to_the_same_frame)
{
    for (uint8_t len = 0; len <= 8; len++) {
        struct frame frame = {.id = 0x100u + len, .len = len};
        memset(frame.data, 0x5A, len);
        char text[SLCAN_TEXT_MAX + 1] = {0};
        slcan_encode(text, &frame);
        assert_decodes(text, &frame);
    }
}

TEST(flags_are_not_part_of_the_identifier)
{
    assert_decodes("T000001220\r", &(struct frame){0x122 | FRAME_EXTENDED, 0, {0}});
    assert_decodes("r1220\r", &(struct frame){0x122 | FRAME_REMOTE, 0, {0}});
}

TEST(incomplete_reply_is_garbled_once)
{
    static const char *const cut[] = {"S\r", "Y\r", "s031\r", "s\r", "M0000000\r", "m\r"};

    for (unsigned i = 0; i < sizeof cut / sizeof cut[0]; i++)
        assert_garbled_once(cut[i]);
}
