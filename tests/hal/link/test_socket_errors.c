/* Opening a socket that fails, and receiving from it. */
#include <errno.h>
#include <stdio.h>
#include <sys/socket.h>
#include <unistd.h>

#include "socket_faults.h"

enum { WAIT_MS = 30 };

static void assert_receive(int expected, int32_t after_ms)
{
    struct frame frame;
    int64_t start = now_ns;
    TEST_ASSERT_EQUAL_INT(expected, link_receive(near, &frame, WAIT_MS));
    TEST_ASSERT_EQUAL_INT64((int64_t)after_ms * NS_PER_MS, now_ns - start);
}

TEST(an_interrupted_receive_is_tried_again)
{
    recv_fault = (struct fault){.error = EINTR, .first = 3};
    put(16, 3);
    assert_receive(1, 0);
}

TEST(a_receive_that_is_always_interrupted_ends)
{
    recv_fault = (struct fault){.error = EINTR, .first = FOR_EVER, .each_ms = 1};
    assert_receive(0, WAIT_MS);
}

TEST(a_wait_that_the_kernel_ends_early_is_waited_to_its_end)
{
    recv_fault = (struct fault){.error = EAGAIN, .first = 1, .each_ms = WAIT_MS / 2};
    assert_receive(0, WAIT_MS);
}

TEST(a_bus_that_is_down_says_so_after_the_wait)
{
    recv_fault = (struct fault){.error = ENETDOWN, .first = 1};
    assert_receive(LINK_E_DOWN, WAIT_MS);
    assert_receive(0, WAIT_MS);
}

TEST(a_bus_that_stays_down_says_so_after_the_wait)
{
    recv_fault = (struct fault){.error = ENETDOWN, .first = FOR_EVER, .each_ms = 1};
    assert_receive(LINK_E_DOWN, WAIT_MS);
}

TEST(a_frame_after_the_bus_was_down_arrives)
{
    recv_fault = (struct fault){.error = ENETDOWN, .first = 1};
    put(16, 3);
    assert_receive(1, 0);
}

TEST(a_receive_from_an_interface_that_is_gone_is_closed)
{
    const int errors[] = {EPERM, ENODEV, ENXIO, ECONNRESET, EBADF};
    for (size_t i = 0; i < sizeof errors / sizeof errors[0]; i++) {
        recv_fault = (struct fault){.error = errors[i], .first = FOR_EVER};
        assert_receive(LINK_E_CLOSED, 0);
    }
}

TEST(a_wait_that_cannot_be_set_is_closed)
{
    setsockopt_fault = (struct fault){.error = EBADF, .first = 1};
    assert_receive(LINK_E_CLOSED, 0);
}

TEST(the_kernel_is_told_a_wait_when_it_changes_and_only_then)
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

TEST(an_empty_datagram_before_a_frame_is_not_the_end)
{
    put(0, 0);
    put(16, 3);
    assert_receive(LINK_E_GARBLED, 0);
    assert_receive(1, 0);
}

/* A signal can end even a look that does not wait. */
TEST(an_empty_datagram_is_garbled_whatever_interrupts_the_look_behind_it)
{
    poll_fault = (struct fault){.error = EINTR, .first = 1};
    put(0, 0);
    put(16, 3);
    assert_receive(LINK_E_GARBLED, 0);
    assert_receive(1, 0);
}

TEST(a_datagram_of_another_size_is_garbled)
{
    const size_t sizes[] = {0, 1, 15, 17, 72};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        put(sizes[i], 3);
        assert_receive(LINK_E_GARBLED, 0);
    }
    put(16, 3);
    assert_receive(1, 0);
}

TEST(a_far_end_that_sends_no_more_is_closed)
{
    TEST_ASSERT_EQUAL_INT(0, shutdown(far, SHUT_WR));
    assert_receive(LINK_E_CLOSED, 0);
}

TEST(a_length_over_eight_is_garbled)
{
    put(16, 9);
    assert_receive(LINK_E_GARBLED, 0);
    put(16, 255);
    assert_receive(LINK_E_GARBLED, 0);
}

TEST(a_descriptor_that_came_non_blocking_waits_all_the_same)
{
    assert_receive(0, WAIT_MS);
}

TEST(no_memory_for_a_link_refuses_it)
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

TEST(a_busy_queue_is_tried_again)
{
    send_fault = (struct fault){.error = ENOBUFS, .first = 3};
    assert_send(0, 3);
    assert_far_has_one_frame();
}

TEST(a_queue_that_stays_busy_is_given_up_in_time)
{
    send_fault = (struct fault){.error = ENOBUFS, .first = FOR_EVER};
    assert_send(LINK_E_FULL, LINK_SEND_MS);
}

TEST(an_interrupted_send_is_tried_again)
{
    send_fault = (struct fault){.error = EINTR, .first = 1};
    assert_send(0, 1);
    assert_far_has_one_frame();
}

TEST(a_send_that_is_always_interrupted_ends)
{
    send_fault = (struct fault){.error = EINTR, .first = FOR_EVER};
    assert_send(LINK_E_FULL, LINK_SEND_MS);
}

TEST(a_send_to_a_bus_that_is_down_says_so_at_once)
{
    send_fault = (struct fault){.error = ENETDOWN, .first = FOR_EVER};
    assert_send(LINK_E_DOWN, 0);
}

TEST(a_send_to_an_interface_that_is_gone_is_closed)
{
    const int errors[] = {EPERM, ENODEV, ENXIO, EPIPE, ECONNRESET, EBADF, ENOTCONN};
    for (size_t i = 0; i < sizeof errors / sizeof errors[0]; i++) {
        send_fault = (struct fault){.error = errors[i], .first = FOR_EVER};
        assert_send(LINK_E_CLOSED, 0);
    }
}
