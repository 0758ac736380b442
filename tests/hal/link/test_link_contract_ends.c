/* link.h, about ends: opening and closing, a far end that is gone, a queue that is full, an interface that comes and goes. */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>

#include "contract.h"

enum { QUEUE_MAX = 1000000 };

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

static int fill(void)
{
    int result = 0;
    for (int i = 0; result == 0 && i < QUEUE_MAX; i++) result = link_send(near, &HELLO);
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
