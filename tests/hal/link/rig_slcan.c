/* The far end of a pty, which speaks slcan in its own words. */
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <unity.h>

#include "rig.h"

static int far = -1;

static void open_pty(char name[RIG_NAME_MAX])
{
    far = posix_openpt(O_RDWR | O_NOCTTY);
    TEST_ASSERT_TRUE(far >= 0);
    TEST_ASSERT_EQUAL_INT(0, grantpt(far));
    TEST_ASSERT_EQUAL_INT(0, unlockpt(far));
    snprintf(name, RIG_NAME_MAX, "slcan:%s", ptsname(far));
}

static void put_text(const char *text)
{
    TEST_ASSERT_EQUAL_INT(strlen(text), write(far, text, strlen(text)));
}

static void put(const struct frame *frame)
{
    char text[40];
    bool extended = frame->id & FRAME_EXTENDED, remote = frame->id & FRAME_REMOTE;
    char type = extended ? (remote ? 'R' : 'T') : (remote ? 'r' : 't');
    const char *format = extended ? "%c%08x%d" : "%c%03x%d";
    int len = sprintf(text, format, type, frame->id & 0x1FFFFFFF, frame->len);
    for (int i = 0; !remote && i < frame->len; i++, len += 2) sprintf(text + len, "%02x", frame->data[i]);
    strcpy(text + len, "\r");
    put_text(text);
}

/* False: no whole line for a while. */
static bool take_line(char line[40])
{
    for (size_t len = 0; poll(&(struct pollfd){.fd = far, .events = POLLIN}, 1, 200) == 1;) {
        TEST_ASSERT_EQUAL_INT(1, read(far, &line[len], 1));
        TEST_ASSERT_TRUE(len < 39);
        if (line[len++] != '\r') continue;
        line[len - 1] = '\0';
        return true;
    }
    return false;
}

static bool parse(const char *line, struct frame *frame)
{
    bool extended = line[0] == 'T' || line[0] == 'R', remote = line[0] == 'r' || line[0] == 'R';
    unsigned id, len;
    if (sscanf(line + 1, extended ? "%8x%1u" : "%3x%1u", &id, &len) != 2) return false;
    id |= (extended ? FRAME_EXTENDED : 0) | (remote ? FRAME_REMOTE : 0);
    *frame = (struct frame){.id = id, .len = (uint8_t)len};
    const char *data = line + (extended ? 10 : 5);
    if (strlen(data) != (remote ? 0 : 2 * len)) return false;
    for (unsigned i = 0; !remote && i < len; i++) sscanf(data + 2 * i, "%2hhx", &frame->data[i]);
    return true;
}

/* Lines cut short, as a full queue leaves them, are passed over. */
static bool take(struct frame *frame)
{
    char line[40];
    while (take_line(line))
        if (parse(line, frame)) return true;
    return false;
}

static void put_garbage(void)
{
    put_text("t1232A\r");
}

static void close_far(void)
{
    if (far >= 0) close(far);
    far = -1;
}

const struct rig RIG_SLCAN = {"slcan", false, open_pty, put, take, put_garbage, close_far};
