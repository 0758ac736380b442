#include "host_sim/sim/native/log_lines.h"

static const char STAMP[LOG_STAMP] = {
    '(', '0', '0', '0', '0', '0', '0', '0', '0', '0', '0', '.', '0', '0', '0', '0', '0', '0', ')',
    ' ', 'o', 'c', 't', 'e', 't', ' ',
};

enum { SECONDS_END = 11, MICROS_END = 18 };   /* within a time stamp */

static void put_digits(char *end, uint64_t number, unsigned count)
{
    for (unsigned i = 0; i < count; i++) {
        *--end = (char)('0' + number % 10);
        number /= 10;
    }
}

void log_lines_stamp(struct log_lines *lines, uint64_t time_us)
{
    for (unsigned i = 0; i < LOG_STAMP; i++)
        lines->stamp[i] = STAMP[i];
    put_digits(lines->stamp + SECONDS_END, time_us / 1000000, 10);
    put_digits(lines->stamp + MICROS_END, time_us % 1000000, 6);
}

static char *put_hex(char *at, uint32_t number, unsigned digits)
{
    static const char hex[] = "0123456789ABCDEF";

    for (unsigned i = digits; i-- > 0;)
        *at++ = hex[number >> 4 * i & 15u];
    return at;
}

void log_lines_add(struct log_lines *lines, const struct frame *frame)
{
    char *at;

    if (!lines->text)
        return;
    at = lines->text + lines->used;
    for (unsigned i = 0; i < LOG_STAMP; i++)
        *at++ = lines->stamp[i];
    at = put_hex(at, frame->id, 3);
    *at++ = '#';
    for (unsigned i = 0; i < frame->len; i++)
        at = put_hex(at, frame->data[i], 2);
    *at++ = '\n';
    lines->used = (size_t)(at - lines->text);
}
