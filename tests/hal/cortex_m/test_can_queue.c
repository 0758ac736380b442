/* Queued frames leave once, in order, as long as there is room. */
#include "can_queue_rig.h"

TEST(idle_controller_gets_a_frame_at_once)
{
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_EQUAL_HEX32(1, controller.waiting);
    TEST_ASSERT_EQUAL_UINT8(0, queue.count);
}

TEST(last_controller_buffer_is_reserved_for_urgent_frames)
{
    block();
    for (uint8_t n = 0; n < 5; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    TEST_ASSERT_EQUAL_HEX32(3, controller.waiting);
    pass_ms(3);
    TEST_ASSERT_EQUAL_HEX32(3, controller.waiting);
    TEST_ASSERT_EQUAL_UINT(5, can_queue_pump(&queue));
    controller.waiting = 7;
    pass_ms(3);
    TEST_ASSERT_EQUAL_UINT8(3, queue.count);
}

TEST(queue_uses_a_free_buffer_at_once)
{
    block();
    TEST_ASSERT_TRUE(put(HEARTBEAT, 0));
    TEST_ASSERT_TRUE(put(HEARTBEAT, 1));
    TEST_ASSERT_EQUAL_HEX32(3, controller.waiting);
}

TEST(queue_sends_each_frame_once_and_in_order)
{
    for (unsigned round = 0; round < 5; round++)
        for (uint8_t n = 0; n < 11; n++)
            TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    pass_ms(20);
    TEST_ASSERT_EQUAL_UINT(55, controller.sent_count);
    for (unsigned n = 0; n < 55; n++)
        assert_sent(n, HEARTBEAT, (uint8_t)(n % 11));
}

TEST(full_queue_accepts_a_frame_when_one_has_left)
{
    uint32_t start;

    for (uint8_t n = 0; n < 10; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    start = controller.now_us;
    TEST_ASSERT_TRUE(put(HEARTBEAT, 10));
    TEST_ASSERT_LESS_THAN_UINT32(start + 1000, controller.now_us);
}

TEST(queue_with_room_accepts_a_frame_at_once)
{
    block();
    TEST_ASSERT_TRUE(put(HEARTBEAT, 0));
    for (uint8_t n = 1; n < 8; n++) {
        uint32_t start = controller.now_us;

        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
        TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + 500, controller.now_us);
    }
}

TEST(queue_with_room_does_not_wait_for_departures)
{
    uint32_t start;

    block();
    for (uint8_t n = 0; n < CAN_QUEUE_MAX - 1; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    controller.frame_us = 900;
    controller.since_us = start = controller.now_us;
    queue.moved_ms = now_ms();
    TEST_ASSERT_TRUE(put(HEARTBEAT, CAN_QUEUE_MAX - 1));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + 500, controller.now_us);
}

TEST(full_queue_refuses_and_counts_a_frame)
{
    block();
    for (uint8_t n = 0; n < 10; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    TEST_ASSERT_FALSE(put(HEARTBEAT, 10));
    TEST_ASSERT_EQUAL_UINT8(1, queue.dropped);
    TEST_ASSERT_EQUAL_UINT8(CAN_QUEUE_MAX, queue.count);
}

/* A controller need not take a frame for which it has a buffer: see can_put. */
TEST(full_queue_keeps_its_frames_if_the_controller_refuses)
{
    for (uint32_t inside = 0; inside <= 1; inside++) {
        setUp();
        block();
        for (uint8_t n = 0; n < 10; n++)
            TEST_ASSERT_TRUE(put(HEARTBEAT, n));
        controller.refuses = true;
        controller.waiting = inside;
        TEST_ASSERT_FALSE(put(HEARTBEAT, 10));
        TEST_ASSERT_EQUAL_UINT8(CAN_QUEUE_MAX, queue.count);
        TEST_ASSERT_EQUAL_UINT8(2, queue.frames[queue.first].data[0]);
    }
}

TEST(dropped_frames_are_counted_up_to_255)
{
    block();
    for (uint8_t n = 0; n < 5; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    queue.dropped = 249;
    can_queue_drop(&queue);
    TEST_ASSERT_EQUAL_UINT8(254, queue.dropped);
    TEST_ASSERT_EQUAL_UINT8(0, queue.count);
    TEST_ASSERT_EQUAL_HEX32(3, controller.aborted);
    for (uint8_t n = 0; n < 2; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    can_queue_drop(&queue);
    TEST_ASSERT_EQUAL_UINT8(255, queue.dropped);
}

/* Outdated frames: none leaves that has waited for longer than LINK_SEND_MS. */

static void wait_since_last_left(uint32_t ms)
{
    queue.moved_ms = now_ms();
    queue.waiting = 1;
    controller.now_us = 1000 * (now_ms() + ms);
}

TEST(frame_that_waited_up_to_the_limit_is_sent)
{
    block();
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    wait_since_last_left(LINK_SEND_MS);
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

TEST(outdated_frame_is_dropped_and_the_new_one_is_sent)
{
    block();
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    wait_since_last_left(LINK_SEND_MS + 1);
    TEST_ASSERT_TRUE(put(MEMORY, 1));
    TEST_ASSERT_EQUAL_UINT8(1, queue.dropped);
    TEST_ASSERT_EQUAL_UINT8(0, queue.count);
    TEST_ASSERT_EQUAL_HEX32(1, controller.waiting);
    TEST_ASSERT_EQUAL_HEX32(MEMORY, controller.buffers[0].id);
}

TEST(outdated_frame_that_is_not_aborted_delays_new_ones)
{
    block();
    controller.keeps = true;
    TEST_ASSERT_TRUE(put(DRIVE, 0));
    wait_since_last_left(LINK_SEND_MS + 1);
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_TRUE(put(HEALTH, 2));
    TEST_ASSERT_EQUAL_HEX32(3, controller.waiting);
    TEST_ASSERT_EQUAL_UINT8(1, queue.count);
}

TEST(abort_does_not_reset_the_age_of_other_frames)
{
    uint32_t start;

    fill_controller(HEALTH, MEMORY, ANSWER);
    start = now_ms();
    TEST_ASSERT_TRUE(put(DRIVE, 1));
    controller.now_us = 1000 * (start + LINK_SEND_MS + 1);
    TEST_ASSERT_TRUE(put(DRIVE, 2));
    TEST_ASSERT_EQUAL_HEX32(7, controller.aborted);
    TEST_ASSERT_EQUAL_UINT8(1 + 3, queue.dropped);
}

TEST(queue_drops_nothing_after_a_long_pause)
{
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    pass_ms(2);
    controller.now_us += 1000000;
    block();
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_TRUE(put(HEALTH, 2));
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

TEST(queue_drops_nothing_while_frames_leave)
{
    controller.frame_us = 8000;
    for (uint8_t n = 0; n < 6; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    for (unsigned i = 0; i < 20; i++) {
        pass_ms(2);
        TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
        if (i % 4 == 0)
            TEST_ASSERT_TRUE(put(HEARTBEAT, 9));
    }
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

TEST(empty_queue_drops_nothing)
{
    queue.moved_ms = now_ms() - 1000;
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    TEST_ASSERT_EQUAL_HEX32(0, controller.aborted);
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

/* The queue at 125 kbit/s, where all that can wait takes longer to leave than a frame may wait. */

/* A full frame takes 1.08 ms; with others' frames between, nearly two. */
static void fill_queue(uint32_t frame_us)
{
    can_queue_begin(&queue, 125000);
    controller.frame_us = frame_us;
    for (uint8_t n = 0; n < CAN_QUEUE_MAX + CAN_BUFFERS - 1; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
}

TEST(urgent_frame_wait_is_bounded_at_125_kbit_s)
{
    uint32_t start;

    fill_queue(1990);
    start = now_ms();
    TEST_ASSERT_TRUE(put(DRIVE, 10));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + LINK_SEND_MS + 1, now_ms());
}

TEST(full_queue_accepts_a_frame_within_3_ms_at_125_kbit_s)
{
    uint32_t start;

    fill_queue(1990);
    start = now_ms();
    TEST_ASSERT_TRUE(put(HEALTH, 10));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + 3, now_ms());
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

TEST(urgent_frame_waits_for_one_under_way_at_125_kbit_s)
{
    can_queue_begin(&queue, 125000);
    controller.frame_us = 1990;
    TEST_ASSERT_TRUE(put(HEARTBEAT, 0));
    TEST_ASSERT_TRUE(put(DRIVE, 1));
    pass_ms(5);
    assert_sent(0, HEARTBEAT, 0);
    assert_sent(1, DRIVE, 1);
}
