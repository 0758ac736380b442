/* link.h, about ends: opening and closing, a far end that is gone, a queue that is full, an interface that comes and goes. */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <signal.h>

#include "contract.h"

enum { QUEUE_MAX = 1000000, FULL_SENDS = 10 };

TEST_IF(a_far_end_that_is_gone_ends_a_receive_at_once, is_pair)
{
    struct frame frame;
    rig->close();

    int64_t start = now_ms();
    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, 10 * LATE_MS));
    TEST_ASSERT_TRUE(now_ms() - start < LATE_MS);
}

TEST_IF(a_far_end_that_left_frames_unread_is_gone_as_well, is_pair)
{
    struct frame frame;
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));
    rig->close();

    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, SOON_MS));
}

TEST_IF(a_far_end_that_is_gone_fails_a_send, is_pair)
{
    rig->close();

    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_send(near, &HELLO));
}

/* Sends until the link stays full: a busy kernel may pass on a terminal's bytes late, and so make room again. */
static int fill(void)
{
    int result = 0;
    for (int i = 0, full = 0; full < FULL_SENDS && i < QUEUE_MAX; i++) {
        result = link_send(near, &HELLO);
        full = result == 0 ? 0 : full + 1;
    }
    return result;
}

TEST_IF(a_full_queue_is_given_up_in_time, is_pair)
{
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, fill());

    int64_t start = now_ms();
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, link_send(near, &HELLO));
    int64_t took = now_ms() - start;
    TEST_ASSERT_TRUE(took >= LINK_SEND_MS);
    TEST_ASSERT_TRUE(took < LATE_MS);
}

TEST_IF(frames_pass_again_after_a_full_queue, is_pair)
{
    struct frame frame;
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, fill());
    while (rig->take(&frame)) assert_equal(&HELLO, &frame);

    TEST_ASSERT_EQUAL_INT(0, link_send(near, &(struct frame){.id = 0x100}));
    assert_far_takes(&(struct frame){.id = 0x100});
}

TEST(a_link_opens_again_after_a_close)
{
    close_near();
    rig->close();
    open_near();
    rig->put(&HELLO);

    assert_receives(&HELLO);
}

static int open_descriptors(void)
{
    int count = 0;
    for (int fd = 0; fd < 1024; fd++) count += fcntl(fd, F_GETFD) != -1;
    return count;
}

TEST(closing_gives_back_every_descriptor)
{
    close_near();
    rig->close();
    int before = open_descriptors();

    open_near();
    close_near();
    rig->close();

    TEST_ASSERT_EQUAL_INT(before, open_descriptors());
}

TEST(a_link_that_cannot_know_says_that_the_bus_is_fine)
{
    struct link_health health;

    memset(&health, 0xEE, sizeof health);
    link_health(near, &health);
    TEST_ASSERT_EQUAL(BUS_ACTIVE, health.state);
    TEST_ASSERT_EQUAL_UINT(0, health.tx_errors + health.rx_errors + health.bus_offs + health.dropped);
}

TEST(closing_no_link_is_fine)
{
    link_close(NULL);
}

/* On an interface of our own, which may come and go. */
static void use_own_interface(void)
{
    tearDown();
    TEST_ASSERT_EQUAL_INT(0, system("ip link add dev octet0 type vcan && ip link set octet0 up"));
    rig_socketcan_choose("octet0");
    open_near();
}

TEST_IF(an_interface_that_goes_down_and_up_carries_on, is_interface)
{
    struct frame frame;
    use_own_interface();
    TEST_ASSERT_EQUAL_INT(0, system("ip link set octet0 down"));

    int64_t start = now_ms();
    TEST_ASSERT_EQUAL_INT(LINK_E_DOWN, link_receive(near, &frame, WAIT_MS));
    TEST_ASSERT_TRUE(now_ms() - start >= WAIT_MS);
    TEST_ASSERT_EQUAL_INT(LINK_E_DOWN, link_send(near, &HELLO));

    TEST_ASSERT_EQUAL_INT(0, system("ip link set octet0 up"));
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));
    TEST_ASSERT_EQUAL_INT(0, system("ip link del octet0"));
}

TEST_IF(an_interface_that_vanishes_is_closed, is_interface)
{
    struct frame frame;
    use_own_interface();
    TEST_ASSERT_EQUAL_INT(0, system("ip link del octet0"));

    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, SOON_MS));
    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_send(near, &HELLO));
}

TEST_IF(an_interface_that_is_not_there_is_refused, is_interface)
{
    struct link *link = NULL;
    TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, link_open(&link, "socketcan:nosuch0", (const uint16_t[]){0x123}, 1));
    TEST_ASSERT_NULL(link);
}

/* link.h, about frames: they arrive as they were, in their order, and what is not wanted is filtered where that is possible. */

TEST(a_frame_from_the_far_end_arrives_as_it_was)
{
    rig->put(&HELLO);

    assert_receives(&HELLO);
}

TEST(a_frame_to_the_far_end_arrives_as_it_was)
{
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));

    assert_far_takes(&HELLO);
}

TEST(what_is_sent_does_not_come_back)
{
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));

    assert_silent_for(WAIT_MS);
}

TEST(every_length_passes_both_ways)
{
    for (uint8_t len = 0; len <= 8; len++) {
        struct frame frame = {.id = 0x123, .len = len};
        memset(frame.data, 0xF0 + len, len);
        rig->put(&frame);
        assert_receives(&frame);
        TEST_ASSERT_EQUAL_INT(0, link_send(near, &frame));
        assert_far_takes(&frame);
    }
}

TEST(frames_keep_their_order)
{
    for (uint16_t i = 0; i < 5; i++) rig->put(&(struct frame){.id = 0x100u + i});

    for (uint16_t i = 0; i < 5; i++) assert_receives(&(struct frame){.id = 0x100u + i});
}

TEST_IF(garbage_counts_once_and_the_next_frame_arrives, is_pair)
{
    struct frame frame;
    rig->put_garbage();
    rig->put(&HELLO);

    TEST_ASSERT_EQUAL_INT(LINK_E_GARBLED, link_receive(near, &frame, SOON_MS));
    assert_receives(&HELLO);
    assert_silent_for(0);
}

/* Where nothing filters, all arrives, with its flags. */
static void assert_unwanted(const struct frame *frame)
{
    rig->put(frame);
    rig->put(&HELLO);
    if (!rig->filters) assert_receives(frame);
    assert_receives(&HELLO);
    assert_silent_for(0);
}

TEST(other_identifiers_are_filtered_where_that_is_possible)
{
    assert_unwanted(&(struct frame){.id = 0x122});
    assert_unwanted(&(struct frame){.id = 0x000});
    assert_unwanted(&(struct frame){.id = 0x7FF});
}

TEST(extended_and_remote_frames_are_filtered_where_that_is_possible)
{
    assert_unwanted(&(struct frame){.id = 0x123 | FRAME_EXTENDED});
    assert_unwanted(&(struct frame){.id = 0x123 | FRAME_REMOTE});
    assert_unwanted(&(struct frame){.id = 0x1FFFF123 | FRAME_EXTENDED | FRAME_REMOTE, .len = 2});
}

TEST(extended_and_remote_frames_can_be_sent)
{
    const struct frame frames[] = {{.id = 0x123 | FRAME_EXTENDED}, {.id = 0x123 | FRAME_REMOTE, .len = 3}};
    for (int i = 0; i < 2; i++) {
        TEST_ASSERT_EQUAL_INT(0, link_send(near, &frames[i]));
        assert_far_takes(&frames[i]);
    }
}

/* link.h, about time: a receive waits for as long as it was told, whatever happens meanwhile. */

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
