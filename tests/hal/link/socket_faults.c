#include "socket_faults.h"

#include <errno.h>
#include <poll.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

enum { NS_PER_S = 1000000000 };

struct fault recv_fault, send_fault, poll_fault, setsockopt_fault, calloc_fault;
struct link *near;
int far, times_told;
int64_t now_ns, receive_timeout_ns;

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

static bool strikes(struct fault *fault)
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

int __wrap_poll(struct pollfd watched[], nfds_t count, int wait_ms)
{
    return strikes(&poll_fault) ? -1 : __real_poll(watched, count, wait_ms);
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

void put(size_t size, uint8_t len)
{
    uint8_t raw[72] = {0x23, 0x01, 0, 0, len};
    TEST_ASSERT_EQUAL_INT(size, write(far, raw, size));
}
