/* Frames as slcan text over a terminal line: a serial port, or a pty. */
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include "hal/link/link_kind.h"
#include "hal/link/slcan.h"

struct slcan_link {
    struct link link;               /* must be first: its address is that of the whole struct */
    int fd;
    struct slcan_decoder decoder;
    char bytes[256];                /* read and not yet decoded: at..end */
    size_t at, end;
    bool cut_short;                 /* the last line sent may lack its end */
};

static bool find_speed(const char *baud, speed_t *speed)
{
    static const struct {
        const char *baud;
        speed_t speed;
    } SPEEDS[] = {{"9600", B9600},     {"19200", B19200},     {"38400", B38400},     {"57600", B57600},
                  {"115200", B115200}, {"230400", B230400},   {"460800", B460800},   {"500000", B500000},
                  {"921600", B921600}, {"1000000", B1000000}, {"2000000", B2000000}, {"3000000", B3000000}};

    for (size_t i = 0; i < sizeof SPEEDS / sizeof SPEEDS[0]; i++)
        if (strcmp(baud, SPEEDS[i].baud) == 0) {
            *speed = SPEEDS[i].speed;
            return true;
        }
    return false;
}

/* Raw bytes in both directions, without modem control. */
static int set_raw(int fd, speed_t speed)
{
    struct termios line;
    if (tcgetattr(fd, &line) != 0)
        return -1;
    cfmakeraw(&line);
    line.c_cflag |= CLOCAL | CREAD;
    line.c_cflag &= (tcflag_t) ~(CRTSCTS | CSTOPB);
    if (cfsetspeed(&line, speed) != 0)
        return -1;
    return tcsetattr(fd, TCSANOW, &line);
}

static struct slcan_link *open_line(const char *path, speed_t speed)
{
    int fd = open(path, O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (fd < 0)
        return NULL;
    struct slcan_link *made = set_raw(fd, speed) == 0 ? calloc(1, sizeof *made) : NULL;
    if (made != NULL) {
        made->link.kind = &LINK_KIND_SLCAN;
        made->fd = fd;
        return made;
    }
    int error = errno;   /* saved, since close may change it */
    close(fd);
    errno = error;
    return NULL;
}

/* Splits PATH or PATH@BAUD; without BAUD, *speed stays as it is. */
static bool split(const char *place, char path[PATH_MAX], speed_t *speed)
{
    if (snprintf(path, PATH_MAX, "%s", place) >= PATH_MAX)
        return false;
    char *baud = strrchr(path, '@');
    if (baud == NULL)
        return true;
    *baud = '\0';
    return find_speed(baud + 1, speed);
}

static int open_slcan(struct link **link, struct link_request *request)
{
    char path[PATH_MAX];
    speed_t speed = B115200;
    if (!split(request->place, path, &speed)) {
        request->why = "no such speed of a serial line, or a path too long";
        return LINK_E_NAME;
    }
    struct slcan_link *made = open_line(path, speed);
    if (made == NULL) {
        request->why = strerror(errno);
        return LINK_E_OPEN;
    }
    *link = &made->link;
    return 0;
}

/* As link_receive, from bytes already read. */
static int decode(struct slcan_link *slcan, struct frame *out)
{
    while (slcan->at < slcan->end) {
        enum slcan_found found = slcan_decode(&slcan->decoder, slcan->bytes[slcan->at++], out);
        if (found == SLCAN_FRAME)
            return 1;
        if (found == SLCAN_GARBLED)
            return LINK_E_GARBLED;
    }
    return 0;
}

/* Reads the available bytes, if any; returns LINK_E_CLOSED at the end. */
static int refill(struct slcan_link *slcan)
{
    ssize_t got = read(slcan->fd, slcan->bytes, sizeof slcan->bytes);
    if (got == 0 || (got < 0 && errno != EAGAIN && errno != EINTR))
        return LINK_E_CLOSED;
    slcan->at = 0;
    slcan->end = got > 0 ? (size_t)got : 0;
    return 0;
}

static int receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    struct slcan_link *slcan = (struct slcan_link *)link;
    int64_t deadline = deadline_in_ms(wait_ms);
    int result = decode(slcan, out);
    if (result != 0)
        return result;
    do {
        result = refill(slcan);
        if (result == 0)
            result = decode(slcan, out);
    } while (result == 0 && deadline_await_input(slcan->fd, deadline));
    return result;
}

/* Writes text by a deadline; returns as link_send. */
static int write_by(int64_t deadline, int fd, const char *text, size_t len)
{
    while (len > 0) {
        ssize_t took = write(fd, text, len);
        if (took == 0 || (took < 0 && errno != EAGAIN && errno != EINTR))
            return LINK_E_CLOSED;
        if (took < 0 && errno == EINTR && deadline_left_ms(deadline) > 0)
            continue;   /* interrupted by a signal, not a full line: retry at once */
        if (took < 0 && !deadline_pause(deadline))
            return LINK_E_FULL;
        if (took < 0)
            continue;
        text += took;
        len -= (size_t)took;
    }
    return 0;
}

/* First ends a line that may have been cut short; otherwise this one would be read as its tail. */
static int send_frame(struct link *link, const struct frame *frame)
{
    struct slcan_link *slcan = (struct slcan_link *)link;
    char text[1 + SLCAN_TEXT_MAX] = "\r";
    size_t prefix = slcan->cut_short ? 1 : 0;
    size_t len = prefix + slcan_encode(text + prefix, frame);
    int result = write_by(deadline_in_ms(LINK_SEND_MS), slcan->fd, text, len);
    slcan->cut_short = result != 0;
    return result;
}

static void close_line(struct link *link)
{
    close(((struct slcan_link *)link)->fd);
    free(link);
}

const struct link_kind LINK_KIND_SLCAN = {"slcan:", open_slcan, receive, send_frame, close_line};
