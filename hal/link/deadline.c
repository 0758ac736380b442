#include "hal/link/link_kind.h"

#include <poll.h>
#include <stddef.h>
#include <time.h>

enum { NS_PER_MS = 1000000, NS_PER_S = 1000000000 };

static int64_t now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * NS_PER_S + now.tv_nsec;
}

int64_t deadline_in_ms(uint32_t ms)
{
    return now_ns() + (int64_t)ms * NS_PER_MS;
}

uint32_t deadline_left_ms(int64_t deadline)
{
    int64_t left = deadline - now_ns();
    return left > 0 ? (uint32_t)((left + NS_PER_MS - 1) / NS_PER_MS) : 0;
}

bool deadline_await_input(int fd, int64_t deadline)
{
    struct pollfd watch = {.fd = fd, .events = POLLIN};
    for (int64_t left = deadline - now_ns(); left > 0; left = deadline - now_ns()) {
        struct timespec wait = {left / NS_PER_S, left % NS_PER_S};
        if (ppoll(&watch, 1, &wait, NULL) > 0)
            return true;
    }
    return false;
}

bool deadline_pause(int64_t deadline)
{
    if (now_ns() >= deadline)
        return false;
    nanosleep(&(struct timespec){0, NS_PER_MS}, NULL);
    return true;
}
