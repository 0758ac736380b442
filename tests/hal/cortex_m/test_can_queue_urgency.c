/* An urgent frame leaves last on a bus that takes frames, and first on one that does not. */
#include "can_queue_rig.h"

TEST(urgent_frame_waits_for_older_frames_on_a_free_bus)
{
    for (uint8_t n = 0; n < 9; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    TEST_ASSERT_TRUE(put(DRIVE, 9));
    pass_ms(3);
    for (uint8_t n = 0; n < 9; n++)
        assert_sent(n, HEARTBEAT, n);
    assert_sent(9, DRIVE, 9);
}

TEST(equally_urgent_frame_waits_behind_a_single_older_one)
{
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    TEST_ASSERT_TRUE(put(ANSWER, 1));
    pass_ms(2);
    assert_sent(0, HEALTH, 0);
    assert_sent(1, ANSWER, 1);
}

/* A frame is stuck once it has not left for longer than one can take: 0.27 ms at 500 kbit/s, which makes 1 whole ms. */
TEST(urgent_frame_waits_for_frames_that_leave_within_1_ms)
{
    uint32_t start = controller.now_us;

    controller.frame_us = 900;
    for (uint8_t n = 0; n < 2; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    TEST_ASSERT_TRUE(put(DRIVE, 2));
    TEST_ASSERT_LESS_THAN_UINT32(start + 2500, controller.now_us);
    pass_ms(5);
    assert_sent(1, HEARTBEAT, 1);
    assert_sent(2, DRIVE, 2);
}

TEST(urgent_frame_does_not_wait_on_a_blocked_bus)
{
    uint32_t start;

    block();
    TEST_ASSERT_TRUE(put(HEARTBEAT, 0));
    pass_ms(1);
    TEST_ASSERT_TRUE(put(HEARTBEAT, 1));
    start = controller.now_us;
    TEST_ASSERT_TRUE(put(DRIVE, 2));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + 1200, controller.now_us);
    controller.frame_us = 250;
    pass_ms(2);
    assert_sent(0, DRIVE, 2);
}

/* Frames of other nodes between ours: each of ours leaves, but all of them would take too long. */
TEST(urgent_frame_waits_as_long_as_an_idle_bus_needs)
{
    uint32_t start;
    unsigned before;

    controller.frame_us = 990;
    for (uint8_t n = 0; n < 9; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    controller.now_us = controller.since_us = 6000000;
    queue.moved_ms = now_ms();
    before = controller.sent_count;
    start = controller.now_us;
    TEST_ASSERT_TRUE(put(DRIVE, 9));
    TEST_ASSERT_UINT32_WITHIN(200, start + 4000, controller.now_us);
    pass_ms(2);
    assert_sent(before + 3, HEARTBEAT, (uint8_t)(before + 3));
    assert_sent(before + 4, DRIVE, 9);
}

TEST(equally_urgent_frame_stays_behind_queued_ones)
{
    block();
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_TRUE(put(ANSWER, 2));   /* in the third buffer */
    TEST_ASSERT_TRUE(put(ANSWER, 3));
    TEST_ASSERT_EQUAL_UINT8(1, queue.count);
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

TEST(urgency_is_compared_with_every_queued_frame)
{
    block();
    queue.first = 6;
    for (unsigned i = 0; i < 4; i++) {
        static const uint32_t ids[] = {HEARTBEAT, HEARTBEAT, HEARTBEAT, ANSWER};

        queue.frames[(6 + i) % CAN_QUEUE_MAX].id = ids[i];
    }
    queue.count = 4;
    fill_controller(HEALTH, HEALTH, 0);
    controller.waiting = 3;
    TEST_ASSERT_TRUE(put(ANSWER, 1));
    TEST_ASSERT_EQUAL_UINT8(5, queue.count);
    TEST_ASSERT_TRUE(put(DRIVE, 2));
    TEST_ASSERT_EQUAL_UINT8(5, queue.count);
    TEST_ASSERT_EQUAL_HEX32(DRIVE, controller.buffers[2].id);
}

/* Nor are frames that have left the queue. */
TEST(free_buffers_are_not_compared_for_urgency)
{
    controller.ids_elsewhere = 1;
    block();
    for (unsigned i = 0; i < CAN_QUEUE_MAX; i++)
        queue.frames[i].id = 1;
    TEST_ASSERT_TRUE(put(HEARTBEAT, 0));
    TEST_ASSERT_TRUE(put(HEARTBEAT, 1));
    TEST_ASSERT_TRUE(put(DRIVE, 2));
    TEST_ASSERT_EQUAL_UINT8(0, queue.count);
    TEST_ASSERT_EQUAL_HEX32(DRIVE, controller.buffers[2].id);
}

TEST(urgent_frame_aborts_the_least_urgent_buffer)
{
    static const uint32_t ids[3][3] = {{HEALTH, MEMORY, ANSWER}, {MEMORY, HEALTH, ANSWER}, {MEMORY, ANSWER, HEALTH}};

    for (unsigned i = 0; i < 3; i++) {
        setUp();
        fill_controller(ids[i][0], ids[i][1], ids[i][2]);
        TEST_ASSERT_TRUE(put(DRIVE, 1));
        TEST_ASSERT_EQUAL_HEX32(1u << i, controller.aborted);
        TEST_ASSERT_EQUAL_HEX32(DRIVE, controller.buffers[i].id);
        TEST_ASSERT_EQUAL_UINT8(1, queue.dropped);
    }
}

TEST(no_frame_is_aborted_while_a_buffer_is_free)
{
    fill_controller(HEALTH, HEALTH, HEALTH);
    controller.waiting = 3;
    TEST_ASSERT_TRUE(put(DRIVE, 1));
    TEST_ASSERT_EQUAL_HEX32(0, controller.aborted);
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

TEST(queue_put_times_out_if_the_controller_aborts_nothing)
{
    uint32_t start;

    fill_controller(HEALTH, HEALTH, HEALTH);
    controller.keeps = true;
    start = controller.now_us;
    TEST_ASSERT_FALSE(put(DRIVE, 1));
    TEST_ASSERT_UINT32_WITHIN(300, start + 1000 * (LINK_SEND_MS + 1), controller.now_us);
    TEST_ASSERT_EQUAL_UINT8(2, queue.dropped);   /* the one that was to be aborted, and the drive */
    TEST_ASSERT_FALSE(put(DRIVE, 2));
    TEST_ASSERT_EQUAL_UINT8(2 + 3 + 2, queue.dropped);   /* all three buffers are outdated by now, and the same two again */
}
