/* The queue at 125 kbit/s, where all that can wait takes longer to leave than a frame may wait. */
#include "can_queue_rig.h"

/* A full frame takes 1.08 ms; with others' frames between, nearly two. */
static void fill_queue(uint32_t frame_us)
{
    can_queue_begin(&queue, 125000);
    controller.frame_us = frame_us;
    for (uint8_t n = 0; n < CAN_QUEUE_MAX + CAN_BUFFERS - 1; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
}

TEST(an_urgent_frame_waits_no_longer_than_promised)
{
    uint32_t start;

    fill_queue(1990);
    start = now_ms();
    TEST_ASSERT_TRUE(put(DRIVE, 10));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + LINK_SEND_MS + 1, now_ms());
}

TEST(a_frame_leaves_in_time_to_let_the_next_one_in)
{
    uint32_t start;

    fill_queue(1990);
    start = now_ms();
    TEST_ASSERT_TRUE(put(HEALTH, 10));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + 3, now_ms());
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

TEST(a_frame_is_stuck_only_once_it_has_had_time_to_leave)
{
    can_queue_begin(&queue, 125000);
    controller.frame_us = 1990;
    TEST_ASSERT_TRUE(put(HEARTBEAT, 0));
    TEST_ASSERT_TRUE(put(DRIVE, 1));
    pass_ms(5);
    assert_sent(0, HEARTBEAT, 0);
    assert_sent(1, DRIVE, 1);
}
