/* The order and the patience of the frames on their way out, whatever the controller is. */
#include "hal/stm32/can_queue.h"

#include <string.h>

#include <unity.h>

#include "can_controller_fake.h"
#include "hal/stm32/machine.h"

enum { DRIVE = 0x041, ANSWER = 0x141, MEMORY = 0x681, HEARTBEAT = 0x6A1, HEALTH = 0x7C1 };

static struct can_queue queue;

void setUp(void)
{
    fake_reset();
    memset(&queue, 0, sizeof queue);
}

void tearDown(void) {}

static bool put(uint32_t id, uint8_t number)
{
    struct frame frame = {.id = id, .len = 1, .data = {number}};

    return can_queue_put(&queue, &frame);
}

static uint32_t now_ms(void)
{
    return controller.now_us / 1000;
}

static void pass_ms(uint32_t ms)
{
    uint32_t end = controller.now_us + 1000 * ms;

    while (controller.now_us < end)
        (void)can_queue_pump(&queue);
}

static void block(void)
{
    controller.frame_us = 0;
}

static void fill_controller(uint32_t first, uint32_t second, uint32_t third)
{
    block();
    controller.waiting = 7;
    queue.moved_ms = now_ms();
    controller.buffers[0].id = first;
    controller.buffers[1].id = second;
    controller.buffers[2].id = third;
}

static void assert_sent(unsigned n, uint32_t id, uint8_t number)
{
    TEST_ASSERT_LESS_THAN_UINT(controller.sent_count, n);
    TEST_ASSERT_EQUAL_HEX32(id, controller.sent[n].id);
    TEST_ASSERT_EQUAL_UINT8(number, controller.sent[n].data[0]);
}

/* ---- what waits */

static void test_a_frame_goes_straight_to_an_idle_controller(void)
{
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_EQUAL_HEX32(1, controller.waiting);
    TEST_ASSERT_EQUAL_UINT8(0, queue.count);
}

static void test_the_controllers_last_buffer_is_kept_for_what_is_urgent(void)
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

static void test_a_free_buffer_is_made_use_of_at_once(void)
{
    block();
    TEST_ASSERT_TRUE(put(HEARTBEAT, 0));
    TEST_ASSERT_TRUE(put(HEARTBEAT, 1));
    TEST_ASSERT_EQUAL_HEX32(3, controller.waiting);
}

static void test_all_that_was_put_leaves_once_and_in_its_order(void)
{
    for (unsigned round = 0; round < 5; round++)
        for (uint8_t n = 0; n < 11; n++)
            TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    pass_ms(20);
    TEST_ASSERT_EQUAL_UINT(55, controller.sent_count);
    for (unsigned n = 0; n < 55; n++)
        assert_sent(n, HEARTBEAT, (uint8_t)(n % 11));
}

static void test_a_full_queue_takes_one_more_as_soon_as_one_has_left(void)
{
    uint32_t start;

    for (uint8_t n = 0; n < 10; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    start = controller.now_us;
    TEST_ASSERT_TRUE(put(HEARTBEAT, 10));
    TEST_ASSERT_LESS_THAN_UINT32(start + 1000, controller.now_us);
}

static void test_a_queue_with_room_makes_nobody_wait(void)
{
    block();
    TEST_ASSERT_TRUE(put(HEARTBEAT, 0));
    for (uint8_t n = 1; n < 8; n++) {
        uint32_t start = controller.now_us;

        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
        TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + 500, controller.now_us);
    }
}

static void test_a_queue_that_stays_full_takes_no_more_and_counts_it(void)
{
    block();
    for (uint8_t n = 0; n < 10; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    TEST_ASSERT_FALSE(put(HEARTBEAT, 10));
    TEST_ASSERT_EQUAL_UINT8(1, queue.dropped);
    TEST_ASSERT_EQUAL_UINT8(CAN_QUEUE_MAX, queue.count);
}

/* A controller need not take a frame for which it has a buffer: see can_put. */
static void test_a_full_queue_overwrites_nothing_where_the_controller_takes_no_more(void)
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

static void test_what_is_dropped_is_counted_and_the_count_stays_at_255(void)
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

/* ---- what is urgent */

static void test_on_a_bus_that_takes_frames_the_urgent_one_lets_them_all_go_first(void)
{
    for (uint8_t n = 0; n < 9; n++)
        TEST_ASSERT_TRUE(put(HEARTBEAT, n));
    TEST_ASSERT_TRUE(put(DRIVE, 9));
    pass_ms(3);
    for (uint8_t n = 0; n < 9; n++)
        assert_sent(n, HEARTBEAT, n);
    assert_sent(9, DRIVE, 9);
}

static void test_even_a_single_one_goes_first(void)
{
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    TEST_ASSERT_TRUE(put(ANSWER, 1));
    pass_ms(2);
    assert_sent(0, HEALTH, 0);
    assert_sent(1, ANSWER, 1);
}

/* A frame is stuck once it has not left for longer than one can take: 0.27 ms at 500 kbit/s, which makes 1 whole ms. */
static void test_frames_that_leave_in_a_millisecond_are_let_go_first(void)
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

static void test_a_bus_without_room_for_the_others_is_not_waited_for(void)
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

/* With others' frames between ours, each of ours leaves, but all of them would take too long. */
static void test_many_that_leave_slowly_are_waited_for_as_long_as_an_idle_bus_needs(void)
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

static void test_what_is_as_urgent_as_what_waits_stays_behind_it(void)
{
    block();
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_TRUE(put(ANSWER, 2));   /* in the third buffer */
    TEST_ASSERT_TRUE(put(ANSWER, 3));
    TEST_ASSERT_EQUAL_UINT8(1, queue.count);
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

static void test_each_that_waits_is_asked_whether_it_is_more_urgent(void)
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

/* A frame that has left the queue is not asked any more, nor is a buffer that is free. */
static void test_what_no_longer_waits_is_not_asked(void)
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

static void test_the_least_urgent_gives_way_wherever_it_is(void)
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

static void test_nothing_gives_way_while_a_buffer_is_free(void)
{
    fill_controller(HEALTH, HEALTH, HEALTH);
    controller.waiting = 3;
    TEST_ASSERT_TRUE(put(DRIVE, 1));
    TEST_ASSERT_EQUAL_HEX32(0, controller.aborted);
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

static void test_a_controller_that_gives_nothing_up_is_waited_for_no_longer_than_promised(void)
{
    uint32_t start;

    fill_controller(HEALTH, HEALTH, HEALTH);
    controller.keeps = true;
    start = controller.now_us;
    TEST_ASSERT_FALSE(put(DRIVE, 1));
    TEST_ASSERT_UINT32_WITHIN(300, start + 1000 * (LINK_SEND_MS + 1), controller.now_us);
    TEST_ASSERT_EQUAL_UINT8(2, queue.dropped);   /* the one that was to give way, and the drive */
    TEST_ASSERT_FALSE(put(DRIVE, 2));
    TEST_ASSERT_EQUAL_UINT8(2 + 3 + 2, queue.dropped);   /* all of it is out of date by now, and the same again */
}

/* ---- what is out of date */

static void wait_since_last_left(uint32_t ms)
{
    queue.moved_ms = now_ms();
    queue.waiting = 1;
    controller.now_us = 1000 * (now_ms() + ms);
}

static void test_what_has_waited_for_as_long_as_promised_is_still_sent(void)
{
    block();
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    wait_since_last_left(LINK_SEND_MS);
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

static void test_what_has_waited_for_longer_is_dropped_and_the_new_one_goes_straight_away(void)
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

static void test_a_controller_that_keeps_what_is_out_of_date_holds_the_new_one_up(void)
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

static void test_what_gives_way_makes_the_others_no_younger(void)
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

static void test_a_long_silence_makes_nothing_out_of_date(void)
{
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    pass_ms(2);
    controller.now_us += 1000000;
    block();
    TEST_ASSERT_TRUE(put(HEALTH, 1));
    TEST_ASSERT_TRUE(put(HEALTH, 2));
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

static void test_as_long_as_something_leaves_nothing_is_out_of_date(void)
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

static void test_nothing_that_waits_is_dropped_for_nothing(void)
{
    queue.moved_ms = now_ms() - 1000;
    TEST_ASSERT_TRUE(put(HEALTH, 0));
    TEST_ASSERT_EQUAL_HEX32(0, controller.aborted);
    TEST_ASSERT_EQUAL_UINT8(0, queue.dropped);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_frame_goes_straight_to_an_idle_controller);
    RUN_TEST(test_the_controllers_last_buffer_is_kept_for_what_is_urgent);
    RUN_TEST(test_a_free_buffer_is_made_use_of_at_once);
    RUN_TEST(test_all_that_was_put_leaves_once_and_in_its_order);
    RUN_TEST(test_a_full_queue_takes_one_more_as_soon_as_one_has_left);
    RUN_TEST(test_a_queue_with_room_makes_nobody_wait);
    RUN_TEST(test_a_queue_that_stays_full_takes_no_more_and_counts_it);
    RUN_TEST(test_a_full_queue_overwrites_nothing_where_the_controller_takes_no_more);
    RUN_TEST(test_what_is_dropped_is_counted_and_the_count_stays_at_255);
    RUN_TEST(test_on_a_bus_that_takes_frames_the_urgent_one_lets_them_all_go_first);
    RUN_TEST(test_even_a_single_one_goes_first);
    RUN_TEST(test_frames_that_leave_in_a_millisecond_are_let_go_first);
    RUN_TEST(test_a_bus_without_room_for_the_others_is_not_waited_for);
    RUN_TEST(test_many_that_leave_slowly_are_waited_for_as_long_as_an_idle_bus_needs);
    RUN_TEST(test_what_is_as_urgent_as_what_waits_stays_behind_it);
    RUN_TEST(test_each_that_waits_is_asked_whether_it_is_more_urgent);
    RUN_TEST(test_what_no_longer_waits_is_not_asked);
    RUN_TEST(test_the_least_urgent_gives_way_wherever_it_is);
    RUN_TEST(test_nothing_gives_way_while_a_buffer_is_free);
    RUN_TEST(test_a_controller_that_gives_nothing_up_is_waited_for_no_longer_than_promised);
    RUN_TEST(test_what_has_waited_for_as_long_as_promised_is_still_sent);
    RUN_TEST(test_what_has_waited_for_longer_is_dropped_and_the_new_one_goes_straight_away);
    RUN_TEST(test_a_controller_that_keeps_what_is_out_of_date_holds_the_new_one_up);
    RUN_TEST(test_what_gives_way_makes_the_others_no_younger);
    RUN_TEST(test_a_long_silence_makes_nothing_out_of_date);
    RUN_TEST(test_as_long_as_something_leaves_nothing_is_out_of_date);
    RUN_TEST(test_nothing_that_waits_is_dropped_for_nothing);
    return UNITY_END();
}
