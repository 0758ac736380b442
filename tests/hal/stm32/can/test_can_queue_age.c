/* What is out of date: nothing leaves that has waited for longer than promised. */
#include "can_queue_rig.h"

static void wait_since_last_left(uint32_t ms)
{
    queue.moved_ms = now_ms();
    queue.waiting = 1;
    controller.now_us = 1000 * (now_ms() + ms);
}

TEST(what_has_waited_for_as_long_as_promised_is_still_sent)
{
    block();
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    wait_since_last_left(LINK_SEND_MS);
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

TEST(what_has_waited_for_longer_is_dropped_and_the_new_one_goes_straight_away)
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

TEST(a_controller_that_keeps_what_is_out_of_date_holds_the_new_one_up)
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

TEST(what_gives_way_makes_the_others_no_younger)
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

TEST(a_long_silence_makes_nothing_out_of_date)
{
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    pass_ms(2);
    controller.now_us += 1000000;
    block();
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_TRUE(put(HEALTH, 2));
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

TEST(as_long_as_something_leaves_nothing_is_out_of_date)
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

TEST(nothing_that_waits_is_dropped_for_nothing)
{
    queue.moved_ms = now_ms() - 1000;
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    TEST_ASSERT_EQUAL_HEX32(0, controller.aborted);
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}
