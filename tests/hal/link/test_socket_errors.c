/* Opening a socket that fails, and receiving from it. */
#include "tests/test.h"
#include "hal/link/link.h"

#include <errno.h>
#include <limits.h>
#include <poll.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

/* Rare socket errors, from fakes of the system calls. Time is a fake as well: it passes only while the link waits, so that a
   busy machine changes nothing. */

enum { FOR_EVER = INT_MAX, NS_PER_MS = 1000000 };

/* The first calls fail, with error, each after some time; the others go through. */
struct fault {
    int error, first, calls, each_ms;
};

enum { NS_PER_S = 1000000000 };

static struct fault recv_fault, send_fault, poll_fault, setsockopt_fault, calloc_fault;
static struct link *near;   /* listens for 0x123 */
static int far, timeout_sets;   /* the other end, which never blocks */
static int64_t now_ns, receive_timeout_ns;

static const uint16_t WANTED[] = {0x123};

ssize_t __real_recv(int fd, void *to, size_t size, int flags);
ssize_t __wrap_recv(int fd, void *to, size_t size, int flags);
ssize_t __real_send(int fd, const void *from, size_t size, int flags);
ssize_t __wrap_send(int fd, const void *from, size_t size, int flags);
int __real_poll(struct pollfd watched[], nfds_t count, int wait_ms);
int __wrap_poll(struct pollfd watched[], nfds_t count, int wait_ms);
int __real_setsockopt(int fd, int level, int name, const void *value, socklen_t size);
int __wrap_setsockopt(int fd, int level, int name, const void *value, socklen_t size);
int __real_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_nanosleep(const struct timespec *wanted, struct timespec *left);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);

static bool should_fail(struct fault *fault)
{
    if (fault->calls >= fault->first) return false;
    fault->calls++;
    now_ns += (int64_t)fault->each_ms * NS_PER_MS;
    errno = fault->error;
    return true;
}

static int64_t in_ns(const struct timespec *time)
{
    return (int64_t)time->tv_sec * NS_PER_S + time->tv_nsec;
}

static int64_t real_ns(void)
{
    struct timespec now;
    __real_clock_gettime(CLOCK_MONOTONIC, &now);
    return in_ns(&now);
}

/* The time that the kernel was told to wait passes if it did wait for as long. */
ssize_t __wrap_recv(int fd, void *to, size_t size, int flags)
{
    if (should_fail(&recv_fault)) return -1;
    int64_t start = real_ns();
    ssize_t received = __real_recv(fd, to, size, flags);
    if (received < 0 && errno == EAGAIN && real_ns() - start >= receive_timeout_ns) now_ns += receive_timeout_ns;
    return received;
}

ssize_t __wrap_send(int fd, const void *from, size_t size, int flags)
{
    return should_fail(&send_fault) ? -1 : __real_send(fd, from, size, flags);
}

int __wrap_poll(struct pollfd watched[], nfds_t count, int wait_ms)
{
    return should_fail(&poll_fault) ? -1 : __real_poll(watched, count, wait_ms);
}

int __wrap_setsockopt(int fd, int level, int name, const void *value, socklen_t size)
{
    if (should_fail(&setsockopt_fault)) return -1;
    if (name == SO_RCVTIMEO) {
        const struct timeval *wait = value;
        timeout_sets++;
        receive_timeout_ns = (int64_t)wait->tv_sec * NS_PER_S + wait->tv_usec * 1000;
    }
    return __real_setsockopt(fd, level, name, value, size);
}

int __wrap_clock_gettime(clockid_t clock, struct timespec *out)
{
    (void)clock;
    *out = (struct timespec){now_ns / NS_PER_S, now_ns % NS_PER_S};
    return 0;
}

int __wrap_nanosleep(const struct timespec *wanted, struct timespec *left)
{
    (void)left;
    now_ns += in_ns(wanted);
    return 0;
}

void *__wrap_calloc(size_t count, size_t size)
{
    return should_fail(&calloc_fault) ? NULL : __real_calloc(count, size);
}

void setUp(void)
{
    int ends[2];
    char name[16];
    now_ns = 0;
    recv_fault = send_fault = poll_fault = setsockopt_fault = calloc_fault = (struct fault){0};
    TEST_ASSERT_EQUAL_INT(0, socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_NONBLOCK, 0, ends));
    far = ends[0];
    snprintf(name, sizeof name, "fd:%d", ends[1]);
    TEST_ASSERT_EQUAL_INT(0, link_open(&near, name, WANTED, 1));
}

void tearDown(void)
{
    link_close(near);
    close(far);
}

/* The far end sends a datagram of this size: a frame with that length, if it is one. */
static void put(size_t size, uint8_t len)
{
    uint8_t raw[72] = {0x23, 0x01, 0, 0, len};
    TEST_ASSERT_EQUAL_INT(size, write(far, raw, size));
}

enum { WAIT_MS = 30 };

static void assert_receive(int expected, int32_t after_ms)
{
    struct frame frame;
    int64_t start = now_ns;
    TEST_ASSERT_EQUAL_INT(expected, link_receive(near, &frame, WAIT_MS));
    TEST_ASSERT_EQUAL_INT64((int64_t)after_ms * NS_PER_MS, now_ns - start);
}

TEST(interrupted_receive_is_retried)
{
    recv_fault = (struct fault){.error = EINTR, .first = 3};
    put(16, 3);
    assert_receive(1, 0);
}

TEST(always_interrupted_receive_times_out)
{
    recv_fault = (struct fault){.error = EINTR, .first = FOR_EVER, .each_ms = 1};
    assert_receive(0, WAIT_MS);
}

TEST(early_kernel_timeout_is_waited_to_its_end)
{
    recv_fault = (struct fault){.error = EAGAIN, .first = 1, .each_ms = WAIT_MS / 2};
    assert_receive(0, WAIT_MS);
}

TEST(receive_reports_bus_down_after_the_wait)
{
    recv_fault = (struct fault){.error = ENETDOWN, .first = 1};
    assert_receive(LINK_E_DOWN, WAIT_MS);
    assert_receive(0, WAIT_MS);
}

TEST(receive_reports_lasting_bus_down_after_the_wait)
{
    recv_fault = (struct fault){.error = ENETDOWN, .first = FOR_EVER, .each_ms = 1};
    assert_receive(LINK_E_DOWN, WAIT_MS);
}

TEST(frame_after_bus_down_is_received)
{
    recv_fault = (struct fault){.error = ENETDOWN, .first = 1};
    put(16, 3);
    assert_receive(1, 0);
}

TEST(receive_on_a_removed_interface_returns_closed_error)
{
    const int errors[] = {EPERM, ENODEV, ENXIO, ECONNRESET, EBADF};
    for (size_t i = 0; i < sizeof errors / sizeof errors[0]; i++) {
        recv_fault = (struct fault){.error = errors[i], .first = FOR_EVER};
        assert_receive(LINK_E_CLOSED, 0);
    }
}

TEST(failed_timeout_setting_returns_closed_error)
{
    setsockopt_fault = (struct fault){.error = EBADF, .first = 1};
    assert_receive(LINK_E_CLOSED, 0);
}

TEST(socket_timeout_is_set_only_when_it_changes)
{
    static const struct {
        uint32_t wait_ms, set_ms;
        int times;
    } cases[] = {{30, 30, 1}, {30, 30, 1}, {0, 30, 1}, {30, 30, 1}, {1, 1, 2}, {1, 1, 2}, {2345, 2345, 3}, {3000, 3000, 4}};
    struct frame frame;
    timeout_sets = 0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        put(16, 3);
        TEST_ASSERT_EQUAL_INT(1, link_receive(near, &frame, cases[i].wait_ms));
        TEST_ASSERT_EQUAL_INT(cases[i].times, timeout_sets);
        TEST_ASSERT_EQUAL_INT64((int64_t)cases[i].set_ms * NS_PER_MS, receive_timeout_ns);
    }
}

TEST(empty_datagram_before_a_frame_is_garbled)
{
    put(0, 0);
    put(16, 3);
    assert_receive(LINK_E_GARBLED, 0);
    assert_receive(1, 0);
}

/* A signal can interrupt even a poll that does not wait. */
TEST(empty_datagram_is_garbled_despite_an_interrupted_poll)
{
    poll_fault = (struct fault){.error = EINTR, .first = 1};
    put(0, 0);
    put(16, 3);
    assert_receive(LINK_E_GARBLED, 0);
    assert_receive(1, 0);
}

TEST(datagram_of_wrong_size_is_garbled)
{
    const size_t sizes[] = {0, 1, 15, 17, 72};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        put(sizes[i], 3);
        assert_receive(LINK_E_GARBLED, 0);
    }
    put(16, 3);
    assert_receive(1, 0);
}

TEST(peer_shutdown_returns_closed_error)
{
    TEST_ASSERT_EQUAL_INT(0, shutdown(far, SHUT_WR));
    assert_receive(LINK_E_CLOSED, 0);
}

TEST(length_over_8_is_garbled)
{
    put(16, 9);
    assert_receive(LINK_E_GARBLED, 0);
    put(16, 255);
    assert_receive(LINK_E_GARBLED, 0);
}

TEST(non_blocking_descriptor_still_waits)
{
    assert_receive(0, WAIT_MS);
}

TEST(failed_allocation_refuses_the_link)
{
    int ends[2];
    char name[16];
    const uint16_t wanted[] = {0x123};
    struct link *link = NULL;
    TEST_ASSERT_EQUAL_INT(0, socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends));
    snprintf(name, sizeof name, "fd:%d", ends[0]);
    calloc_fault = (struct fault){.error = ENOMEM, .first = 1};

    TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, link_open(&link, name, wanted, 1));
    TEST_ASSERT_NULL(link);
    TEST_ASSERT_EQUAL_INT(0, close(ends[0]));
    TEST_ASSERT_EQUAL_INT(0, close(ends[1]));
}

/* Sending to a socket that fails. */

static const struct frame HELLO = {0x123, 3, {0xAA, 0xBB, 0xCC}};

static void assert_send(int expected, int32_t after_ms)
{
    int64_t start = now_ns;
    TEST_ASSERT_EQUAL_INT(expected, link_send(near, &HELLO));
    TEST_ASSERT_EQUAL_INT64((int64_t)after_ms * NS_PER_MS, now_ns - start);
}

static void assert_far_has_one_frame(void)
{
    uint8_t raw[72];
    TEST_ASSERT_EQUAL_INT(16, read(far, raw, sizeof raw));
    TEST_ASSERT_EQUAL_INT(-1, read(far, raw, sizeof raw));
}

TEST(full_send_queue_is_retried)
{
    send_fault = (struct fault){.error = ENOBUFS, .first = 3};
    assert_send(0, 3);
    assert_far_has_one_frame();
}

TEST(full_send_queue_times_out)
{
    send_fault = (struct fault){.error = ENOBUFS, .first = FOR_EVER};
    assert_send(LINK_E_FULL, LINK_SEND_MS);
}

TEST(interrupted_send_is_retried)
{
    send_fault = (struct fault){.error = EINTR, .first = 1};
    assert_send(0, 1);
    assert_far_has_one_frame();
}

TEST(always_interrupted_send_times_out)
{
    send_fault = (struct fault){.error = EINTR, .first = FOR_EVER};
    assert_send(LINK_E_FULL, LINK_SEND_MS);
}

TEST(send_reports_bus_down_at_once)
{
    send_fault = (struct fault){.error = ENETDOWN, .first = FOR_EVER};
    assert_send(LINK_E_DOWN, 0);
}

TEST(send_on_a_removed_interface_returns_closed_error)
{
    const int errors[] = {EPERM, ENODEV, ENXIO, EPIPE, ECONNRESET, EBADF, ENOTCONN};
    for (size_t i = 0; i < sizeof errors / sizeof errors[0]; i++) {
        send_fault = (struct fault){.error = errors[i], .first = FOR_EVER};
        assert_send(LINK_E_CLOSED, 0);
    }
}
