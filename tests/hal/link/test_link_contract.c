/* link.h: opening and closing, a closed peer, a full queue, an interface that comes and goes. */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <signal.h>

#include "contract.h"

enum { QUEUE_MAX = 1000000, FULL_SENDS = 10 };

TEST_IF(receive_ends_at_once_when_the_peer_closes, is_pair)
{
    struct frame frame;
    rig->close();

    int64_t start = now_ms();
    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, 10 * LATE_MS));
    TEST_ASSERT_TRUE(now_ms() - start < LATE_MS);
}

TEST_IF(peer_that_closes_with_unread_frames_closes_the_link, is_pair)
{
    struct frame frame;
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));
    rig->close();

    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, SOON_MS));
}

TEST_IF(send_to_a_closed_peer_fails, is_pair)
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

TEST_IF(send_to_a_full_queue_times_out, is_pair)
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

TEST(link_reopens_after_close)
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

TEST(link_close_releases_every_descriptor)
{
    close_near();
    rig->close();
    int before = open_descriptors();

    open_near();
    close_near();
    rig->close();

    TEST_ASSERT_EQUAL_INT(before, open_descriptors());
}

TEST(link_without_bus_state_reports_an_active_bus)
{
    struct link_health health;

    memset(&health, 0xEE, sizeof health);
    link_health(near, &health);
    TEST_ASSERT_EQUAL(BUS_ACTIVE, health.state);
    TEST_ASSERT_EQUAL_UINT(0, health.tx_errors + health.rx_errors + health.bus_offs + health.dropped);
}

TEST(link_close_accepts_null)
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

TEST_IF(link_works_again_after_its_interface_went_down, is_interface)
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

TEST_IF(removed_interface_closes_the_link, is_interface)
{
    struct frame frame;
    use_own_interface();
    TEST_ASSERT_EQUAL_INT(0, system("ip link del octet0"));

    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, SOON_MS));
    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_send(near, &HELLO));
}

TEST_IF(missing_interface_is_refused, is_interface)
{
    struct link *link = NULL;
    TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, link_open(&link, "socketcan:nosuch0", (const uint16_t[]){0x123}, 1));
    TEST_ASSERT_NULL(link);
}

/* link.h: frames arrive unchanged and in order, and unwanted ones are filtered if that is supported. */

TEST(received_frame_is_unchanged)
{
    rig->put(&HELLO);

    assert_receives(&HELLO);
}

TEST(sent_frame_is_unchanged)
{
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));

    assert_far_takes(&HELLO);
}

TEST(link_does_not_receive_its_own_frames)
{
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));

    assert_silent_for(WAIT_MS);
}

TEST(frames_of_every_length_pass_both_ways)
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

/* Without filters all frames arrive, with their flags. */
static void assert_unwanted(const struct frame *frame)
{
    rig->put(frame);
    rig->put(&HELLO);
    if (!rig->filters) assert_receives(frame);
    assert_receives(&HELLO);
    assert_silent_for(0);
}

TEST(unwanted_identifiers_are_filtered_if_supported)
{
    assert_unwanted(&(struct frame){.id = 0x122});
    assert_unwanted(&(struct frame){.id = 0x000});
    assert_unwanted(&(struct frame){.id = 0x7FF});
}

TEST(extended_and_remote_frames_are_filtered_if_supported)
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

/* link.h: a receive waits for exactly the time asked for. */

TEST(receive_returns_silence_after_the_wait)
{
    assert_silent_for(WAIT_MS);
}

TEST(changed_wait_takes_effect)
{
    assert_silent_for(WAIT_MS);
    assert_silent_for(2 * WAIT_MS);
    assert_silent_for(1);
}

TEST(receive_with_no_wait_returns_at_once)
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

TEST(signals_do_not_shorten_a_wait)
{
    struct sigaction action = {.sa_handler = on_alarm};
    TEST_ASSERT_EQUAL_INT(0, sigaction(SIGALRM, &action, NULL));

    set_alarm_each_ms(7);
    assert_silent_for(WAIT_MS);
    set_alarm_each_ms(0);
}

TEST(late_signal_does_not_prolong_a_wait)
{
    struct frame frame;
    struct sigaction action = {.sa_handler = on_alarm};
    TEST_ASSERT_EQUAL_INT(0, sigaction(SIGALRM, &action, NULL));

    int64_t start = now_ms();
    set_alarm_each_ms(5 * WAIT_MS);
    TEST_ASSERT_EQUAL_INT(0, link_receive(near, &frame, 6 * WAIT_MS));
    set_alarm_each_ms(0);
    TEST_ASSERT_TRUE(now_ms() - start < 6 * WAIT_MS + LATE_MS);   /* a wait restarted by each signal would never end */
}
