/* What sockets seldom say, said to the link by fakes of the system calls. Time is a fake as well: it passes only while
   the link waits, so that a busy machine changes nothing. */
#include <errno.h>
#include <limits.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>
#include <unity.h>

#include "hal/link/link.h"

enum { FOR_EVER = INT_MAX, WAIT_MS = 30, NS_PER_MS = 1000000, NS_PER_S = 1000000000 };

/* The first calls fail, with error, each after some time; the others go through. */
struct fault {
    int error, first, calls, each_ms;
};

static struct fault recv_fault, send_fault, setsockopt_fault, calloc_fault;

static const struct frame HELLO = {0x123, 3, {0xAA, 0xBB, 0xCC}};
static const uint16_t WANTED[] = {0x123};
static struct link *near;
static int far;
static int64_t now_ns, receive_timeout_ns;
static int times_told;   /* how long to wait */

static bool strikes(struct fault *fault)
{
    if (fault->calls >= fault->first) return false;
    fault->calls++;
    now_ns += (int64_t)fault->each_ms * NS_PER_MS;
    errno = fault->error;
    return true;
}

ssize_t __real_recv(int fd, void *to, size_t size, int flags);
ssize_t __wrap_recv(int fd, void *to, size_t size, int flags);
ssize_t __real_send(int fd, const void *from, size_t size, int flags);
ssize_t __wrap_send(int fd, const void *from, size_t size, int flags);
int __real_setsockopt(int fd, int level, int name, const void *value, socklen_t size);
int __wrap_setsockopt(int fd, int level, int name, const void *value, socklen_t size);
int __real_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_nanosleep(const struct timespec *wanted, struct timespec *left);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);

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
    if (strikes(&recv_fault)) return -1;
    int64_t start = real_ns();
    ssize_t received = __real_recv(fd, to, size, flags);
    if (received < 0 && errno == EAGAIN && real_ns() - start >= receive_timeout_ns) now_ns += receive_timeout_ns;
    return received;
}

ssize_t __wrap_send(int fd, const void *from, size_t size, int flags)
{
    return strikes(&send_fault) ? -1 : __real_send(fd, from, size, flags);
}

int __wrap_setsockopt(int fd, int level, int name, const void *value, socklen_t size)
{
    if (strikes(&setsockopt_fault)) return -1;
    if (name == SO_RCVTIMEO) {
        const struct timeval *wait = value;
        times_told++;
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
    return strikes(&calloc_fault) ? NULL : __real_calloc(count, size);
}

void setUp(void)
{
    int ends[2];
    char name[16];
    now_ns = 0;
    recv_fault = send_fault = setsockopt_fault = calloc_fault = (struct fault){0};
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

static void assert_receive(int expected, int32_t after_ms)
{
    struct frame frame;
    int64_t start = now_ns;
    TEST_ASSERT_EQUAL_INT(expected, link_receive(near, &frame, WAIT_MS));
    TEST_ASSERT_EQUAL_INT64((int64_t)after_ms * NS_PER_MS, now_ns - start);
}

static void assert_send(int expected, int32_t after_ms)
{
    int64_t start = now_ns;
    TEST_ASSERT_EQUAL_INT(expected, link_send(near, &HELLO));
    TEST_ASSERT_EQUAL_INT64((int64_t)after_ms * NS_PER_MS, now_ns - start);
}

static void put(size_t size, uint8_t len)
{
    uint8_t raw[72] = {0x23, 0x01, 0, 0, len};
    TEST_ASSERT_EQUAL_INT(size, write(far, raw, size));
}

static void assert_far_has_one_frame(void)
{
    uint8_t raw[72];
    TEST_ASSERT_EQUAL_INT(16, read(far, raw, sizeof raw));
    TEST_ASSERT_EQUAL_INT(-1, read(far, raw, sizeof raw));
}

static void test_a_busy_queue_is_tried_again(void)
{
    send_fault = (struct fault){.error = ENOBUFS, .first = 3};
    assert_send(0, 3);
    assert_far_has_one_frame();
}

static void test_a_queue_that_stays_busy_is_given_up_in_time(void)
{
    send_fault = (struct fault){.error = ENOBUFS, .first = FOR_EVER};
    assert_send(LINK_E_FULL, LINK_SEND_MS);
}

static void test_an_interrupted_send_is_tried_again(void)
{
    send_fault = (struct fault){.error = EINTR, .first = 1};
    assert_send(0, 1);
    assert_far_has_one_frame();
}

static void test_a_send_that_is_always_interrupted_ends(void)
{
    send_fault = (struct fault){.error = EINTR, .first = FOR_EVER};
    assert_send(LINK_E_FULL, LINK_SEND_MS);
}

static void test_a_send_to_a_bus_that_is_down_says_so_at_once(void)
{
    send_fault = (struct fault){.error = ENETDOWN, .first = FOR_EVER};
    assert_send(LINK_E_DOWN, 0);
}

static void test_a_send_to_an_interface_that_is_gone_is_closed(void)
{
    const int errors[] = {EPERM, ENODEV, ENXIO, EPIPE, ECONNRESET, EBADF, ENOTCONN};
    for (size_t i = 0; i < sizeof errors / sizeof errors[0]; i++) {
        send_fault = (struct fault){.error = errors[i], .first = FOR_EVER};
        assert_send(LINK_E_CLOSED, 0);
    }
}

static void test_an_interrupted_receive_is_tried_again(void)
{
    recv_fault = (struct fault){.error = EINTR, .first = 3};
    put(16, 3);
    assert_receive(1, 0);
}

static void test_a_receive_that_is_always_interrupted_ends(void)
{
    recv_fault = (struct fault){.error = EINTR, .first = FOR_EVER, .each_ms = 1};
    assert_receive(0, WAIT_MS);
}

static void test_a_wait_that_the_kernel_ends_early_is_waited_to_its_end(void)
{
    recv_fault = (struct fault){.error = EAGAIN, .first = 1, .each_ms = WAIT_MS / 2};
    assert_receive(0, WAIT_MS);
}

static void test_a_bus_that_is_down_says_so_after_the_wait(void)
{
    recv_fault = (struct fault){.error = ENETDOWN, .first = 1};
    assert_receive(LINK_E_DOWN, WAIT_MS);
    assert_receive(0, WAIT_MS);
}

static void test_a_bus_that_stays_down_says_so_after_the_wait(void)
{
    recv_fault = (struct fault){.error = ENETDOWN, .first = FOR_EVER, .each_ms = 1};
    assert_receive(LINK_E_DOWN, WAIT_MS);
}

static void test_a_frame_after_the_bus_was_down_arrives(void)
{
    recv_fault = (struct fault){.error = ENETDOWN, .first = 1};
    put(16, 3);
    assert_receive(1, 0);
}

static void test_a_receive_from_an_interface_that_is_gone_is_closed(void)
{
    const int errors[] = {EPERM, ENODEV, ENXIO, ECONNRESET, EBADF};
    for (size_t i = 0; i < sizeof errors / sizeof errors[0]; i++) {
        recv_fault = (struct fault){.error = errors[i], .first = FOR_EVER};
        assert_receive(LINK_E_CLOSED, 0);
    }
}

static void test_a_wait_that_cannot_be_set_is_closed(void)
{
    setsockopt_fault = (struct fault){.error = EBADF, .first = 1};
    assert_receive(LINK_E_CLOSED, 0);
}

static void test_the_kernel_is_told_a_wait_when_it_changes_and_only_then(void)
{
    static const struct {
        uint32_t wait_ms, told_ms;
        int times;
    } cases[] = {{30, 30, 1}, {30, 30, 1}, {0, 30, 1}, {30, 30, 1}, {1, 1, 2}, {1, 1, 2}, {2345, 2345, 3}, {3000, 3000, 4}};
    struct frame frame;
    times_told = 0;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        put(16, 3);
        TEST_ASSERT_EQUAL_INT(1, link_receive(near, &frame, cases[i].wait_ms));
        TEST_ASSERT_EQUAL_INT(cases[i].times, times_told);
        TEST_ASSERT_EQUAL_INT64((int64_t)cases[i].told_ms * NS_PER_MS, receive_timeout_ns);
    }
}

static void test_an_empty_datagram_before_a_frame_is_not_the_end(void)
{
    put(0, 0);
    put(16, 3);
    assert_receive(LINK_E_GARBLED, 0);
    assert_receive(1, 0);
}

static void test_a_datagram_of_another_size_is_garbled(void)
{
    const size_t sizes[] = {0, 1, 15, 17, 72};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        put(sizes[i], 3);
        assert_receive(LINK_E_GARBLED, 0);
    }
    put(16, 3);
    assert_receive(1, 0);
}

static void test_a_far_end_that_sends_no_more_is_closed(void)
{
    TEST_ASSERT_EQUAL_INT(0, shutdown(far, SHUT_WR));
    assert_receive(LINK_E_CLOSED, 0);
}

static void test_a_length_over_eight_is_garbled(void)
{
    put(16, 9);
    assert_receive(LINK_E_GARBLED, 0);
    put(16, 255);
    assert_receive(LINK_E_GARBLED, 0);
}

static void test_a_descriptor_that_came_non_blocking_waits_all_the_same(void)
{
    assert_receive(0, WAIT_MS);
}

static void test_no_memory_for_a_link_refuses_it(void)
{
    int ends[2];
    char name[16];
    struct link *link = NULL;
    TEST_ASSERT_EQUAL_INT(0, socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends));
    snprintf(name, sizeof name, "fd:%d", ends[0]);
    calloc_fault = (struct fault){.error = ENOMEM, .first = 1};

    TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, link_open(&link, name, WANTED, 1));
    TEST_ASSERT_NULL(link);
    TEST_ASSERT_EQUAL_INT(0, close(ends[0]));
    TEST_ASSERT_EQUAL_INT(0, close(ends[1]));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_busy_queue_is_tried_again);
    RUN_TEST(test_a_queue_that_stays_busy_is_given_up_in_time);
    RUN_TEST(test_an_interrupted_send_is_tried_again);
    RUN_TEST(test_a_send_that_is_always_interrupted_ends);
    RUN_TEST(test_a_send_to_a_bus_that_is_down_says_so_at_once);
    RUN_TEST(test_a_send_to_an_interface_that_is_gone_is_closed);
    RUN_TEST(test_an_interrupted_receive_is_tried_again);
    RUN_TEST(test_a_receive_that_is_always_interrupted_ends);
    RUN_TEST(test_a_wait_that_the_kernel_ends_early_is_waited_to_its_end);
    RUN_TEST(test_a_bus_that_is_down_says_so_after_the_wait);
    RUN_TEST(test_a_bus_that_stays_down_says_so_after_the_wait);
    RUN_TEST(test_a_frame_after_the_bus_was_down_arrives);
    RUN_TEST(test_a_receive_from_an_interface_that_is_gone_is_closed);
    RUN_TEST(test_a_wait_that_cannot_be_set_is_closed);
    RUN_TEST(test_the_kernel_is_told_a_wait_when_it_changes_and_only_then);
    RUN_TEST(test_an_empty_datagram_before_a_frame_is_not_the_end);
    RUN_TEST(test_a_datagram_of_another_size_is_garbled);
    RUN_TEST(test_a_far_end_that_sends_no_more_is_closed);
    RUN_TEST(test_a_length_over_eight_is_garbled);
    RUN_TEST(test_a_descriptor_that_came_non_blocking_waits_all_the_same);
    RUN_TEST(test_no_memory_for_a_link_refuses_it);
    return UNITY_END();
}
