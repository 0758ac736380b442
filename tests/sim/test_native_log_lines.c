#include "host_sim/sim/native/log_lines.h"

#include <string.h>

#include "tests/test.h"

static char text[4 * LOG_LINE_MAX];
static struct log_lines lines;

void setUp(void)
{
    memset(text, 0, sizeof text);
    lines = (struct log_lines){.text = text};
}

TEST(a_line_is_candumps)
{
    struct frame frame = {0x101, 8, {0x00, 0x12, 0xAB, 0xCD, 0xEF, 0xFF, 0x09, 0x90}};

    log_lines_stamp(&lines, 1020000);
    log_lines_add(&lines, &frame);
    TEST_ASSERT_EQUAL_STRING("(0000000001.020000) octet 101#0012ABCDEFFF0990\n", text);
    TEST_ASSERT_EQUAL_size_t(strlen(text), lines.used);
    TEST_ASSERT_TRUE(strlen(text) <= LOG_LINE_MAX);
}

TEST(short_and_empty_frames_and_small_identifiers)
{
    struct frame frames[2] = {{0x021, 2, {0x12, 0x34}}, {0x001, 0, {0}}};

    log_lines_stamp(&lines, 0);
    log_lines_add(&lines, &frames[0]);
    log_lines_add(&lines, &frames[1]);
    TEST_ASSERT_EQUAL_STRING("(0000000000.000000) octet 021#1234\n(0000000000.000000) octet 001#\n", text);
}

TEST(every_digit_of_the_time)
{
    struct frame frame = {0x7C1, 0, {0}};

    log_lines_stamp(&lines, 1234567890987654u);
    log_lines_add(&lines, &frame);
    TEST_ASSERT_EQUAL_STRING("(1234567890.987654) octet 7C1#\n", text);
}
