/* link.h, about time: a receive waits for as long as it was told, whatever happens meanwhile. */
#include <signal.h>
#include <sys/time.h>

#include "contract.h"

TEST(silence_is_said_after_the_wait)
{
    assert_silent_for(WAIT_MS);
}

TEST(a_changed_wait_is_kept)
{
    assert_silent_for(WAIT_MS);
    assert_silent_for(2 * WAIT_MS);
    assert_silent_for(1);
}

TEST(a_wait_of_zero_just_looks)
{
    assert_silent_for(0);
    rig->put(&HELLO);
    assert_receives(&HELLO);
    assert_silent_for(0);
}

static void on_alarm(int signal)
{
    (void)signal;
}

static void set_alarm_each_ms(int ms)
{
    struct itimerval timer = {{0, ms * 1000}, {0, ms * 1000}};
    TEST_ASSERT_EQUAL_INT(0, setitimer(ITIMER_REAL, &timer, NULL));
}

TEST(signals_do_not_cut_a_wait_short)
{
    struct sigaction action = {.sa_handler = on_alarm};
    TEST_ASSERT_EQUAL_INT(0, sigaction(SIGALRM, &action, NULL));

    set_alarm_each_ms(7);
    assert_silent_for(WAIT_MS);
    set_alarm_each_ms(0);
}

TEST(a_signal_late_in_a_wait_does_not_prolong_it)
{
    struct frame frame;
    struct sigaction action = {.sa_handler = on_alarm};
    TEST_ASSERT_EQUAL_INT(0, sigaction(SIGALRM, &action, NULL));

    int64_t start = now_ms();
    set_alarm_each_ms(5 * WAIT_MS);
    TEST_ASSERT_EQUAL_INT(0, link_receive(near, &frame, 6 * WAIT_MS));
    set_alarm_each_ms(0);
    TEST_ASSERT_TRUE(now_ms() - start < 6 * WAIT_MS + LATE_MS);   /* begun anew by each signal, it would never end */
}
