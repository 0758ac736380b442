/* Sending to a socket that fails. */
#include <errno.h>
#include <unistd.h>

#include "socket_faults.h"

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
