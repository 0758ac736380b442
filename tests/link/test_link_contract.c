/* What link.h promises, asked of the kind of link that the first argument names: fd, slcan, or socketcan [IFACE]. */
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>
#include <unity.h>

#include "rig.h"

enum { SOON_MS = 5000, WAIT_MS = 60, LATE_MS = 5000, QUEUE_MAX = 1000000 };

static const uint16_t WANTED[] = {0x123, 0x100, 0x101, 0x102, 0x103, 0x104};
static const struct frame HELLO = {0x123, 3, {0xAA, 0xBB, 0xCC}};

static const struct rig *rig;
static struct link *near;

static void open_near(void)
{
    char name[RIG_NAME_MAX];
    rig->open(name);
    TEST_ASSERT_EQUAL_INT(0, link_open(&near, name, WANTED, sizeof WANTED / sizeof WANTED[0]));
}

static void close_near(void)
{
    link_close(near);
    near = NULL;
}

void setUp(void)
{
    open_near();
}

void tearDown(void)
{
    close_near();
    rig->close();
}

static int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static void assert_equal(const struct frame *expected, const struct frame *frame)
{
    TEST_ASSERT_EQUAL_HEX32(expected->id, frame->id);
    TEST_ASSERT_EQUAL_UINT8(expected->len, frame->len);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected->data, frame->data, 8);
}

static void assert_receives(const struct frame *expected)
{
    struct frame frame;
    memset(&frame, 0xEE, sizeof frame);
    TEST_ASSERT_EQUAL_INT(1, link_receive(near, &frame, SOON_MS));
    assert_equal(expected, &frame);
}

static void assert_far_takes(const struct frame *expected)
{
    struct frame frame;
    TEST_ASSERT_TRUE(rig->take(&frame));
    assert_equal(expected, &frame);
}

static void assert_silent_for(uint32_t wait_ms)
{
    struct frame frame;
    int64_t start = now_ms();
    TEST_ASSERT_EQUAL_INT(0, link_receive(near, &frame, wait_ms));
    int64_t took = now_ms() - start;
    TEST_ASSERT_TRUE(took >= (int64_t)wait_ms);
    TEST_ASSERT_TRUE(took < (int64_t)wait_ms + LATE_MS);
}

static void test_a_frame_from_the_far_end_arrives_as_it_was(void)
{
    rig->put(&HELLO);

    assert_receives(&HELLO);
}

static void test_a_frame_to_the_far_end_arrives_as_it_was(void)
{
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));

    assert_far_takes(&HELLO);
}

static void test_what_is_sent_does_not_come_back(void)
{
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));

    assert_silent_for(WAIT_MS);
}

static void test_every_length_passes_both_ways(void)
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

static void test_frames_keep_their_order(void)
{
    for (uint16_t i = 0; i < 5; i++) rig->put(&(struct frame){.id = 0x100u + i});

    for (uint16_t i = 0; i < 5; i++) assert_receives(&(struct frame){.id = 0x100u + i});
}

static void test_silence_is_said_after_the_wait(void)
{
    assert_silent_for(WAIT_MS);
}

static void test_a_changed_wait_is_kept(void)
{
    assert_silent_for(WAIT_MS);
    assert_silent_for(2 * WAIT_MS);
    assert_silent_for(1);
}

static void test_a_wait_of_zero_just_looks(void)
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

static void test_signals_do_not_cut_a_wait_short(void)
{
    struct sigaction action = {.sa_handler = on_alarm};
    TEST_ASSERT_EQUAL_INT(0, sigaction(SIGALRM, &action, NULL));

    set_alarm_each_ms(7);
    assert_silent_for(WAIT_MS);
    set_alarm_each_ms(0);
}

static void test_a_signal_late_in_a_wait_does_not_prolong_it(void)
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

static void test_garbage_counts_once_and_the_next_frame_arrives(void)
{
    struct frame frame;
    rig->put_garbage();
    rig->put(&HELLO);

    TEST_ASSERT_EQUAL_INT(LINK_E_GARBLED, link_receive(near, &frame, SOON_MS));
    assert_receives(&HELLO);
    assert_silent_for(0);
}

static void test_a_far_end_that_is_gone_ends_a_receive_at_once(void)
{
    struct frame frame;
    rig->close();

    int64_t start = now_ms();
    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, 10 * LATE_MS));
    TEST_ASSERT_TRUE(now_ms() - start < LATE_MS);
}

static void test_a_far_end_that_left_frames_unread_is_gone_as_well(void)
{
    struct frame frame;
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));
    rig->close();

    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, SOON_MS));
}

static void test_a_far_end_that_is_gone_fails_a_send(void)
{
    rig->close();

    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_send(near, &HELLO));
}

static int fill(void)
{
    int result = 0;
    for (int i = 0; result == 0 && i < QUEUE_MAX; i++) result = link_send(near, &HELLO);
    return result;
}

static void test_a_full_queue_is_given_up_in_time(void)
{
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, fill());

    int64_t start = now_ms();
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, link_send(near, &HELLO));
    int64_t took = now_ms() - start;
    TEST_ASSERT_TRUE(took >= LINK_SEND_MS);
    TEST_ASSERT_TRUE(took < LATE_MS);
}

static void test_frames_pass_again_after_a_full_queue(void)
{
    struct frame frame;
    TEST_ASSERT_EQUAL_INT(LINK_E_FULL, fill());
    while (rig->take(&frame)) assert_equal(&HELLO, &frame);

    TEST_ASSERT_EQUAL_INT(0, link_send(near, &(struct frame){.id = 0x100}));
    assert_far_takes(&(struct frame){.id = 0x100});
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

static void test_other_identifiers_are_filtered_where_that_is_possible(void)
{
    assert_unwanted(&(struct frame){.id = 0x122});
    assert_unwanted(&(struct frame){.id = 0x000});
    assert_unwanted(&(struct frame){.id = 0x7FF});
}

static void test_extended_and_remote_frames_are_filtered_where_that_is_possible(void)
{
    assert_unwanted(&(struct frame){.id = 0x123 | FRAME_EXTENDED});
    assert_unwanted(&(struct frame){.id = 0x123 | FRAME_REMOTE});
    assert_unwanted(&(struct frame){.id = 0x1FFFF123 | FRAME_EXTENDED | FRAME_REMOTE, .len = 2});
}

static void test_extended_and_remote_frames_can_be_sent(void)
{
    const struct frame frames[] = {{.id = 0x123 | FRAME_EXTENDED}, {.id = 0x123 | FRAME_REMOTE, .len = 3}};
    for (int i = 0; i < 2; i++) {
        TEST_ASSERT_EQUAL_INT(0, link_send(near, &frames[i]));
        assert_far_takes(&frames[i]);
    }
}

static void test_a_link_opens_again_after_a_close(void)
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

static void test_closing_gives_back_every_descriptor(void)
{
    close_near();
    rig->close();
    int before = open_descriptors();

    open_near();
    close_near();
    rig->close();

    TEST_ASSERT_EQUAL_INT(before, open_descriptors());
}

static void test_a_link_that_cannot_know_says_that_the_bus_is_fine(void)
{
    struct link_health health;

    memset(&health, 0xEE, sizeof health);
    link_health(near, &health);
    TEST_ASSERT_EQUAL(BUS_ACTIVE, health.state);
    TEST_ASSERT_EQUAL_UINT(0, health.tx_errors + health.rx_errors + health.bus_offs + health.dropped);
}

static void test_closing_no_link_is_fine(void)
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

static void test_an_interface_that_goes_down_and_up_carries_on(void)
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

static void test_an_interface_that_vanishes_is_closed(void)
{
    struct frame frame;
    use_own_interface();
    TEST_ASSERT_EQUAL_INT(0, system("ip link del octet0"));

    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_receive(near, &frame, SOON_MS));
    TEST_ASSERT_EQUAL_INT(LINK_E_CLOSED, link_send(near, &HELLO));
}

static void test_an_interface_that_is_not_there_is_refused(void)
{
    struct link *link = NULL;
    TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, link_open(&link, "socketcan:nosuch0", WANTED, 1));
    TEST_ASSERT_NULL(link);
}

static const struct rig *find_rig(const char *kind)
{
    const struct rig *const rigs[] = {&RIG_FD, &RIG_SLCAN, &RIG_SOCKETCAN};
    for (int i = 0; i < 3; i++)
        if (strcmp(kind, rigs[i]->kind) == 0) return rigs[i];
    return NULL;
}

static void run_for_all(void)
{
    RUN_TEST(test_a_frame_from_the_far_end_arrives_as_it_was);
    RUN_TEST(test_a_frame_to_the_far_end_arrives_as_it_was);
    RUN_TEST(test_what_is_sent_does_not_come_back);
    RUN_TEST(test_every_length_passes_both_ways);
    RUN_TEST(test_frames_keep_their_order);
    RUN_TEST(test_silence_is_said_after_the_wait);
    RUN_TEST(test_a_changed_wait_is_kept);
    RUN_TEST(test_a_wait_of_zero_just_looks);
    RUN_TEST(test_signals_do_not_cut_a_wait_short);
    RUN_TEST(test_a_signal_late_in_a_wait_does_not_prolong_it);
    RUN_TEST(test_other_identifiers_are_filtered_where_that_is_possible);
    RUN_TEST(test_extended_and_remote_frames_are_filtered_where_that_is_possible);
    RUN_TEST(test_extended_and_remote_frames_can_be_sent);
    RUN_TEST(test_a_link_opens_again_after_a_close);
    RUN_TEST(test_closing_gives_back_every_descriptor);
    RUN_TEST(test_a_link_that_cannot_know_says_that_the_bus_is_fine);
    RUN_TEST(test_closing_no_link_is_fine);
}

/* A pair has one far end, which a bus has not, and a queue of its own. */
static void run_for_pairs(void)
{
    RUN_TEST(test_garbage_counts_once_and_the_next_frame_arrives);
    RUN_TEST(test_a_far_end_that_is_gone_ends_a_receive_at_once);
    RUN_TEST(test_a_far_end_that_left_frames_unread_is_gone_as_well);
    RUN_TEST(test_a_far_end_that_is_gone_fails_a_send);
    RUN_TEST(test_a_full_queue_is_given_up_in_time);
    RUN_TEST(test_frames_pass_again_after_a_full_queue);
}

static void run_for_interfaces(const char *interface)
{
    RUN_TEST(test_an_interface_that_is_not_there_is_refused);
    RUN_TEST(test_an_interface_that_goes_down_and_up_carries_on);
    rig_socketcan_choose(interface);
    RUN_TEST(test_an_interface_that_vanishes_is_closed);
}

int main(int argc, char *argv[])
{
    rig = find_rig(argc > 1 ? argv[1] : "");
    if (rig == NULL) {
        fprintf(stderr, "usage: %s fd|slcan|socketcan [IFACE]\n", argv[0]);
        return 2;
    }
    const char *interface = argc > 2 ? argv[2] : "vcan0";
    rig_socketcan_choose(interface);
    UNITY_BEGIN();
    run_for_all();
    if (rig == &RIG_SOCKETCAN) run_for_interfaces(interface);
    else run_for_pairs();
    return UNITY_END();
}
