/* Waiting, with a fake clock. */
#include "hal/link/link_kind.h"

#include <poll.h>
#include <signal.h>
#include <string.h>
#include <time.h>

#include "tests/test.h"

enum { NS_PER_S = 1000000000, FD = 42, POLLS_MAX = 4 };

static struct poll_of_test {
    int64_t passes_ns;   /* while it waits */
    int result;
    struct timespec waited;   /* as it was asked to */
} polls[POLLS_MAX];

static int64_t time_ns;
static unsigned polled;

int __wrap_clock_gettime(clockid_t clock, struct timespec *out);
int __wrap_ppoll(struct pollfd *watch, nfds_t count, const struct timespec *wait, const sigset_t *mask);

int __wrap_clock_gettime(clockid_t clock, struct timespec *out)
{
    (void)clock;
    *out = (struct timespec){time_ns / NS_PER_S, time_ns % NS_PER_S};
    return 0;
}

int __wrap_ppoll(struct pollfd *watch, nfds_t count, const struct timespec *wait, const sigset_t *mask)
{
    struct poll_of_test *poll_now = &polls[polled++];

    TEST_ASSERT_LESS_OR_EQUAL_UINT(POLLS_MAX, polled);
    TEST_ASSERT_EQUAL_UINT(1, count);
    TEST_ASSERT_EQUAL_INT(FD, watch->fd);
    TEST_ASSERT_EQUAL_HEX16(POLLIN, watch->events);
    TEST_ASSERT_NULL(mask);
    poll_now->waited = *wait;
    time_ns += poll_now->passes_ns;
    return poll_now->result;
}

void setUp(void)
{
    memset(polls, 0, sizeof polls);
    polled = 0;
    time_ns = 10 * (int64_t)NS_PER_S + 999999999;
}

TEST(remaining_time_is_rounded_up_to_milliseconds)
{
    static const struct {
        int64_t after_ns;
        uint32_t left_ms;
    } cases[] = {{0, 5}, {1, 5}, {999999, 5}, {1000000, 4}, {4999999, 1}, {5000000, 0}, {5000001, 0}, {10000000, 0}};
    const int64_t deadline = deadline_in_ms(5);
    const int64_t begun = time_ns;

    for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
        time_ns = begun + cases[i].after_ns;
        TEST_ASSERT_EQUAL_UINT32(cases[i].left_ms, deadline_left_ms(deadline));
    }
}

TEST(deadline_may_be_seconds_away)
{
    const int64_t deadline = deadline_in_ms(2000);

    time_ns += 2 * NS_PER_S - 1;
    TEST_ASSERT_EQUAL_UINT32(1, deadline_left_ms(deadline));
    time_ns++;
    TEST_ASSERT_EQUAL_UINT32(0, deadline_left_ms(deadline));
}

TEST(await_input_waits_for_the_remaining_time)
{
    polls[0] = (struct poll_of_test){.passes_ns = 2500000000, .result = 0};
    TEST_ASSERT_FALSE(deadline_await_input(FD, deadline_in_ms(2500)));
    TEST_ASSERT_EQUAL_UINT(1, polled);
    TEST_ASSERT_EQUAL_INT64(2, polls[0].waited.tv_sec);
    TEST_ASSERT_EQUAL_INT64(500000000, polls[0].waited.tv_nsec);
}

TEST(await_input_returns_at_input)
{
    polls[0] = (struct poll_of_test){.passes_ns = 1, .result = 1};
    TEST_ASSERT_TRUE(deadline_await_input(FD, deadline_in_ms(10)));
    TEST_ASSERT_EQUAL_UINT(1, polled);
}

TEST(await_input_continues_after_a_signal)
{
    polls[0] = (struct poll_of_test){.passes_ns = NS_PER_S + 1, .result = -1};
    polls[1] = (struct poll_of_test){.passes_ns = 0, .result = 1};
    TEST_ASSERT_TRUE(deadline_await_input(FD, deadline_in_ms(2000)));
    TEST_ASSERT_EQUAL_UINT(2, polled);
    TEST_ASSERT_EQUAL_INT64(0, polls[1].waited.tv_sec);
    TEST_ASSERT_EQUAL_INT64(NS_PER_S - 1, polls[1].waited.tv_nsec);
}

TEST(shortened_wait_continues_to_the_last_nanosecond)
{
    polls[0] = (struct poll_of_test){.passes_ns = NS_PER_S - 1, .result = 0};
    polls[1] = (struct poll_of_test){.passes_ns = 1, .result = 0};
    TEST_ASSERT_FALSE(deadline_await_input(FD, deadline_in_ms(1000)));
    TEST_ASSERT_EQUAL_UINT(2, polled);
    TEST_ASSERT_EQUAL_INT64(1, polls[0].waited.tv_sec);
    TEST_ASSERT_EQUAL_INT64(0, polls[0].waited.tv_nsec);
    TEST_ASSERT_EQUAL_INT64(1, polls[1].waited.tv_nsec);
}

TEST(passed_deadline_is_not_waited_for)
{
    TEST_ASSERT_FALSE(deadline_await_input(FD, deadline_in_ms(0)));
    TEST_ASSERT_EQUAL_UINT(0, polled);
}

TEST(late_wait_is_not_repeated)
{
    polls[0] = (struct poll_of_test){.passes_ns = NS_PER_S, .result = 0};
    TEST_ASSERT_FALSE(deadline_await_input(FD, deadline_in_ms(10)));
    TEST_ASSERT_EQUAL_UINT(1, polled);
}
