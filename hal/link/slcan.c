#include "hal/link/slcan.h"

#include <stdbool.h>

enum { STANDARD_DIGITS = 3, EXTENDED_DIGITS = 8, TIME_DIGITS = 4, DATA_MAX = 8 };

static const uint32_t STANDARD_MAX = 0x7FF;
static const uint32_t EXTENDED_MAX = 0x1FFFFFFF;

/* The unread rest of a line. Reading past its end or reading a non-digit marks it as bad for good. */
struct cursor {
    const char *at;
    const char *end;
    bool bad;
};

static uint32_t digit(char c)
{
    if (c >= '0' && c <= '9')
        return (uint32_t)(c - '0');
    if (c >= 'A' && c <= 'F')
        return (uint32_t)(c - 'A' + 10);
    if (c >= 'a' && c <= 'f')
        return (uint32_t)(c - 'a' + 10);
    return 16;
}

static uint32_t read_hex(struct cursor *text, unsigned digits)
{
    uint32_t value = 0;
    while (digits-- > 0 && !text->bad) {
        uint32_t next = text->at < text->end ? digit(*text->at++) : 16;
        text->bad = next > 15;
        value = value << 4 | next;
    }
    return value;
}

static uint32_t read_id(struct cursor *text, char type)
{
    bool extended = type == 'T' || type == 'R';
    bool remote = type == 'r' || type == 'R';
    uint32_t id = read_hex(text, extended ? EXTENDED_DIGITS : STANDARD_DIGITS);
    text->bad |= id > (extended ? EXTENDED_MAX : STANDARD_MAX);
    return id | (extended ? FRAME_EXTENDED : 0) | (remote ? FRAME_REMOTE : 0);
}

/* Reads the optional time stamp; nothing may follow. */
static void read_end(struct cursor *text)
{
    if (text->at < text->end)
        (void)read_hex(text, TIME_DIGITS);
    text->bad |= text->at < text->end;
}

static enum slcan_found read_frame(struct cursor text, struct frame *out)
{
    struct frame frame = {0};
    frame.id = read_id(&text, *text.at++);
    frame.len = (uint8_t)read_hex(&text, 1);
    if (frame.len > DATA_MAX)
        return SLCAN_GARBLED;
    unsigned bytes = frame.id & FRAME_REMOTE ? 0 : frame.len;
    for (unsigned i = 0; i < bytes; i++)
        frame.data[i] = (uint8_t)read_hex(&text, 2);
    read_end(&text);
    if (text.bad)
        return SLCAN_GARBLED;
    *out = frame;
    return SLCAN_FRAME;
}

/* Replies and set-up commands have a fixed length, which distinguishes them from the tail of a frame's line. */
static bool is_aside(const char *line, size_t len)
{
    static const struct {
        char letter;
        uint8_t len;
    } ASIDES[] = {
        {'z', 1}, {'Z', 1},                                               /* the adapter's reply to a frame sent */
        {'O', 1}, {'L', 1}, {'C', 1}, {'S', 2}, {'Y', 2}, {'s', 5},       /* open, close, speed */
        {'V', 1}, {'N', 1}, {'F', 1}, {'Z', 2}, {'M', 9}, {'m', 9} /* version, state, time on or off, filter */
    };

    for (size_t i = 0; i < sizeof ASIDES / sizeof ASIDES[0]; i++)
        if (line[0] == ASIDES[i].letter && len == ASIDES[i].len)
            return true;
    return false;
}

static enum slcan_found read_line(const char *line, size_t len, struct frame *out)
{
    if (len == 0)
        return SLCAN_NOTHING;
    if (len > SLCAN_LINE_MAX)
        return SLCAN_GARBLED;
    if (is_aside(line, len))
        return SLCAN_NOTHING;
    if (line[0] != 't' && line[0] != 'T' && line[0] != 'r' && line[0] != 'R')
        return SLCAN_GARBLED;
    return read_frame((struct cursor){line, line + len, false}, out);
}

enum slcan_found slcan_decode(struct slcan_decoder *decoder, char byte, struct frame *out)
{
    if (byte == '\r' || byte == '\a') { /* \a: "refused", a reply without \r */
        enum slcan_found found = read_line(decoder->line, decoder->len, out);
        decoder->len = 0;
        return found;
    }
    if (decoder->len < SLCAN_LINE_MAX)
        decoder->line[decoder->len] = byte;
    if (decoder->len <= SLCAN_LINE_MAX)
        decoder->len++;
    return SLCAN_NOTHING;
}

static char *write_hex(char *to, uint32_t value, unsigned digits)
{
    while (digits-- > 0)
        *to++ = "0123456789ABCDEF"[value >> 4 * digits & 15];
    return to;
}

size_t slcan_encode(char text[SLCAN_TEXT_MAX], const struct frame *frame)
{
    bool extended = frame->id & FRAME_EXTENDED;
    bool remote = frame->id & FRAME_REMOTE;
    char *to = text;
    *to++ = "tTrR"[2 * remote + extended];
    to = write_hex(to, frame->id & EXTENDED_MAX, extended ? EXTENDED_DIGITS : STANDARD_DIGITS);
    to = write_hex(to, frame->len, 1);
    for (unsigned i = 0; !remote && i < frame->len; i++)
        to = write_hex(to, frame->data[i], 2);
    *to++ = '\r';
    return (size_t)(to - text);
}
