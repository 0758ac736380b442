/* A fake serial line with partial writes and failing reads. While a frame is sent, time passes only where the link sleeps: a
   busy machine changes nothing. */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <time.h>
#include <unistd.h>

#include "tests/test.h"
#include "hal/link/link.h"

enum { NS_PER_MS = 1000000, NS_PER_S = 1000000000, SOON_MS = 5000, QUIET_MS = 50 };

static const struct frame HELLO = {0x123, 2, {0xAB, 0xCD}};
static const struct frame EMPTY = {.id = 0x100};
static const uint16_t WANTED[] = {0x123};

static size_t room;       /* bytes that the line takes, then it is full */
static size_t piece;      /* at most so many at once, either way */
static struct {           /* how the first calls fail */
    int error;            /* 0: as if no byte had passed */
    int times;
    int each_ms;          /* that it takes */
} write_fault, read_fault;
static int64_t sending_ns; /* the time while a frame is sent; 0: none is */
static int32_t took_ms;    /* the last sending */
static struct link *near;
static int far;

int __real_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_nanosleep(const struct timespec *wanted, struct timespec *left);
ssize_t __real_write(int fd, const void *from, size_t size);
ssize_t __wrap_write(int fd, const void *from, size_t size);
ssize_t __real_read(int fd, void *to, size_t size);
ssize_t __wrap_read(int fd, void *to, size_t size);

static ssize_t fail(int error)
{
    errno = error;
    return error == 0 ? 0 : -1;
}

ssize_t __wrap_write(int fd, const void *from, size_t size)
{
    if (write_fault.times-- > 0) {
        sending_ns += (int64_t)write_fault.each_ms * NS_PER_MS;
        return fail(write_fault.error);
    }
    if (room == 0) return fail(EAGAIN);
    if (size > piece) size = piece;
    if (size > room) size = room;
    room -= size;
    return __real_write(fd, from, size);
}

ssize_t __wrap_read(int fd, void *to, size_t size)
{
    if (read_fault.times-- > 0) return fail(read_fault.error);
    return __real_read(fd, to, size < piece ? size : piece);
}

int __wrap_clock_gettime(clockid_t clock, struct timespec *out)
{
    if (sending_ns == 0) return __real_clock_gettime(clock, out);
    *out = (struct timespec){sending_ns / NS_PER_S, sending_ns % NS_PER_S};
    return 0;
}

int __wrap_nanosleep(const struct timespec *wanted, struct timespec *left)
{
    (void)left;
    sending_ns += wanted->tv_nsec;
    return 0;
}

static int send_frame(const struct frame *frame)
{
    sending_ns = 1;
    int result = link_send(near, frame);
    took_ms = (int32_t)((sending_ns - 1) / NS_PER_MS);
    sending_ns = 0;
    return result;
}

void setUp(void)
{
    char name[64];
    room = piece = 1000;
    memset(&write_fault, 0, sizeof write_fault);
    memset(&read_fault, 0, sizeof read_fault);
    far = posix_openpt(O_RDWR | O_NOCTTY);
    TEST_ASSERT_EQUAL_INT(0, grantpt(far));
    TEST_ASSERT_EQUAL_INT(0, unlockpt(far));
    snprintf(name, sizeof name, "slcan:%s", ptsname(far));
    TEST_ASSERT_EQUAL_INT(0, link_open(&near, name, WANTED, 1));
}

void tearDown(void)
{
    link_close(near);
    close(far);
}

static void assert_far_reads(const char *expected)
{
    char text[100] = {0};
    size_t len = 0;
    while (len < sizeof text - 1
           && poll(&(struct pollfd){.fd = far, .events = POLLIN}, 1, len < strlen(expected) ? SOON_MS : QUIET_MS) == 1)
        len += (size_t)read(far, text + len, sizeof text - 1 - len);
    TEST_ASSERT_EQUAL_STRING(expected, text);
}

static void put(const char *text)
{
    TEST_ASSERT_EQUAL_INT(strlen(text), __real_write(far, text, strlen(text)));
}

TEST(link_open_sends_nothing)
{
    assert_far_reads("");
}

TEST(partial_writes_send_the_line_whole)
{
    piece = 3;
    TEST_ASSERT_EQUAL_INT(0, send_frame(&HELLO));
    assert_far_reads("t1232ABCD\r");
}

/* The send takes as long as the signals do. */
TEST(interrupted_write_is_retried_without_a_pause)
{
    static const int cases_ms[] = {0, 1, LINK_SEND_MS - 1};
    for (size_t i = 0; i < sizeof cases_ms / sizeof *cases_ms; i++) {
        write_fault.error = EINTR;
        write_fault.times = 1;
        write_fault.each_ms = cases_ms[i];
        TEST_ASSERT_EQUAL_INT(0, send_frame(&HELLO));
        TEST_ASSERT_EQUAL_INT(cases_ms[i], took_ms);
    }
    assert_far_reads("t1232ABCD\rt1232ABCD\rt1232ABCD\r");
}

TEST(interrupt_at_the_deadline_ends_the_send)
{
    write_fault.error = EINTR;
    write_fault.times = 1;
    write_fault.each_ms = LINK_SEND_MS;
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, send_frame(&HELLO));
    TEST_ASSERT_EQUAL_INT(LINK_SEND_MS, took_ms);
    assert_far_reads("");
}

TEST(full_line_is_retried_each_millisecond_until_timeout)
{
    write_fault.error = EAGAIN;
    write_fault.times = 3;
    TEST_ASSERT_EQUAL_INT(0, send_frame(&HELLO));
    TEST_ASSERT_EQUAL_INT(3, took_ms);
    assert_far_reads("t1232ABCD\r");
    room = 0;
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, send_frame(&HELLO));
    TEST_ASSERT_EQUAL_INT(LINK_SEND_MS, took_ms);
}

TEST(failed_write_closes_the_link)
{
    static const int errors[] = {0, EPERM, EIO, ENODEV, EBADF, EPIPE};
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++) {
        write_fault.error = errors[i];
        write_fault.times = 1;
        TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, send_frame(&HELLO));
        TEST_ASSERT_EQUAL_INT(0, took_ms);
    }
}

TEST(cut_line_is_terminated_before_the_next)
{
    room = 4;
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, send_frame(&HELLO));
    room = 1000;
    TEST_ASSERT_EQUAL_INT(0, send_frame(&EMPTY));
    TEST_ASSERT_EQUAL_INT(0, send_frame(&EMPTY));
    assert_far_reads("t123\rt1000\rt1000\r");
}

TEST(cut_line_stays_cut_while_the_line_is_full)
{
    room = 4;
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, send_frame(&HELLO));
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, send_frame(&HELLO));
    room = 1000;
    TEST_ASSERT_EQUAL_INT(0, send_frame(&EMPTY));
    assert_far_reads("t123\rt1000\r");
}

TEST(failed_read_closes_the_link)
{
    static const int errors[] = {0, EPERM, EIO, ENODEV, EBADF};
    struct frame frame;
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++) {
        read_fault.error = errors[i];
        read_fault.times = 1;
        TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, SOON_MS));
    }
}

TEST(interrupted_or_empty_read_is_retried)
{
    static const int errors[] = {EINTR, EAGAIN};
    struct frame frame;
    for (size_t i = 0; i < sizeof errors / sizeof *errors; i++) {
        put("t1232ABCD\r");
        read_fault.error = errors[i];
        read_fault.times = 1;
        TEST_ASSERT_EQUAL_INT(1, link_receive(near, &frame, SOON_MS));
        TEST_ASSERT_EQUAL_HEX8_ARRAY(HELLO.data, frame.data, 8);
    }
}

TEST(other_slcan_lines_do_not_end_a_receive)
{
    struct frame frame;
    put("C\rS6\rO\r\a\rz\r");
    TEST_ASSERT_EQUAL_INT(0, link_receive(near, &frame, 20));
}

TEST(line_received_in_pieces_is_one_frame)
{
    struct frame frame;
    put("t1232A");
    TEST_ASSERT_EQUAL_INT(0, link_receive(near, &frame, 20));
    put("BCD\r");
    TEST_ASSERT_EQUAL_INT(1, link_receive(near, &frame, SOON_MS));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(HELLO.data, frame.data, 8);
}

TEST(link_receives_a_line_that_comes_byte_by_byte)
{
    struct frame frame;
    piece = 1;
    put("t1232ABCD\r");
    TEST_ASSERT_EQUAL_INT(1, link_receive(near, &frame, SOON_MS));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(HELLO.data, frame.data, 8);
}

TEST(lines_received_at_once_are_all_decoded)
{
    struct frame frame;
    put("t1232A\rt1232A\rt1232ABCD\r");
    TEST_ASSERT_EQUAL_INT(LINK_E_GARBLED, link_receive(near, &frame, SOON_MS));
    TEST_ASSERT_EQUAL_INT(LINK_E_GARBLED, link_receive(near, &frame, SOON_MS));
    TEST_ASSERT_EQUAL_INT(1, link_receive(near, &frame, SOON_MS));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(HELLO.data, frame.data, 8);
}

TEST(default_baud_rate_is_115200)
{
    struct termios line;
    TEST_ASSERT_EQUAL_INT(0, tcgetattr(far, &line));
    TEST_ASSERT_EQUAL_UINT(B115200, cfgetospeed(&line));
}
