/* What every CAN controller's driver has to do, with the link on top of it: sending. Built once with each rig. */
#include "can_link_cases.h"

void setUp(void)
{
    rig_reset();
    TEST_ASSERT_EQUAL(0, open_link());
    rig_pass_us(100);
}

TEST(sent_frame_is_unchanged)
{
    struct frame frame = {.id = 0x7A5, .len = 3, .data = {0x11, 0x82, 0xF3}};

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
    rig_pass_us(1500);
    TEST_ASSERT_EQUAL_UINT(1, rig_sent_count());
    assert_frame(&frame, rig_sent(0));
}

TEST(eight_bytes_are_sent_in_order)
{
    struct frame frame = {.id = 0x001, .len = 8, .data = {0x81, 0x92, 0xA3, 0xB4, 0xC5, 0xD6, 0xE7, 0xF8}};

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
    rig_pass_us(1500);
    assert_frame(&frame, rig_sent(0));
}

/* All that a robot tells of itself when it is asked: nothing is lost, and the drive is the last. */
TEST(frames_leave_in_order_on_an_idle_bus)
{
    static const uint32_t ids[] = {ANSWER, HEARTBEAT, MEMORY, MEMORY, 0x781, 0x781, 0x7A1, HEALTH, DRIVE};
    enum { COUNT = sizeof ids / sizeof ids[0] };

    for (uint8_t n = 0; n < COUNT; n++)
        send_numbered(ids[n], n);
    wait_ms(WAIT_MS);
    TEST_ASSERT_EQUAL_UINT(COUNT, rig_sent_count());
    for (uint8_t n = 0; n < COUNT; n++)
        assert_sent(n, ids[n], n);
    TEST_ASSERT_EQUAL_UINT8(0, health_now().dropped);
}

TEST(frames_of_one_identifier_keep_their_order)
{
    rig_block(true);
    for (uint8_t n = 0; n < 8; n++)
        send_numbered(DRIVE, n);
    rig_block(false);
    wait_ms(5);
    for (uint8_t n = 0; n < 8; n++)
        assert_sent(n, DRIVE, n);
    TEST_ASSERT_EQUAL_UINT8(0, health_now().dropped);
}

/* Other nodes fill the bus with less urgent frames. */
TEST(drive_leaves_at_once_on_a_loaded_bus)
{
    rig_occupy(0x300);
    for (uint8_t tick = 0; tick < 8; tick++) {
        uint32_t start = rig_ms();

        for (unsigned i = 0; i < 4; i++)
            (void)try_to_send(i < 2 ? HEARTBEAT : MEMORY, tick);
        send_numbered(DRIVE, tick);
        rig_pass_us(600);
        TEST_ASSERT_EQUAL_UINT(tick + 1u, rig_sent_count());
        assert_sent(tick, DRIVE, tick);
        TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + 4, rig_ms());
        wait_ms(16);
    }
}

TEST(urgent_frame_replaces_the_least_urgent)
{
    rig_block(true);
    send_numbered(HEARTBEAT, 0);
    send_numbered(HEALTH, 1);
    send_numbered(ANSWER, 2);
    send_numbered(DRIVE, 3);
    rig_block(false);
    wait_ms(5);
    TEST_ASSERT_EQUAL_UINT(3, rig_sent_count());
    assert_sent(0, DRIVE, 3);
    assert_sent(1, ANSWER, 2);
    assert_sent(2, HEARTBEAT, 0);
    TEST_ASSERT_EQUAL_UINT8(1, health_now().dropped);
}

TEST(less_urgent_frame_stays_behind_queued_ones)
{
    rig_occupy(0x300);
    send_numbered(HEALTH, 0);
    send_numbered(HEALTH, 1);
    send_numbered(ANSWER, 2);
    send_numbered(MEMORY, 3);
    rig_pass_us(600);
    send_numbered(HEARTBEAT, 4);
    rig_occupy(0);
    wait_ms(5);
    TEST_ASSERT_EQUAL_UINT(5, rig_sent_count());
    assert_sent(0, ANSWER, 2);
    for (unsigned n = 1; n < 5; n++)
        if (rig_sent(n)->id == MEMORY)
            assert_sent(n + 1, HEARTBEAT, 4);
}

TEST(send_to_a_stuck_controller_times_out)
{
    uint32_t start;

    rig_stall();
    send_numbered(HEALTH, 0);
    send_numbered(HEARTBEAT, 1);
    send_numbered(ANSWER, 2);
    start = rig_ms();
    TEST_ASSERT_EQUAL(LINK_E_FULL, try_to_send(DRIVE, 3));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + LINK_SEND_MS + 6, rig_ms());
}

TEST(send_on_a_blocked_bus_times_out)
{
    uint32_t start;

    rig_block(true);
    TEST_ASSERT_GREATER_THAN_UINT(8, fill_up());
    start = rig_ms();
    TEST_ASSERT_EQUAL(LINK_E_FULL, try_to_send(HEARTBEAT, 0));
    TEST_ASSERT_EQUAL(0, try_to_send(DRIVE, 0));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + 2 * LINK_SEND_MS, rig_ms());
    TEST_ASSERT_EQUAL_UINT8(2, health_now().dropped);
}

TEST(blocked_frames_are_dropped_and_the_newest_drive_leaves)
{
    unsigned count;

    rig_block(true);
    count = fill_up();
    send_numbered(DRIVE, 1);
    wait_ms(20);
    send_numbered(DRIVE, 2);
    TEST_ASSERT_EQUAL_UINT8(count + 2, health_now().dropped);   /* the first drive, and one more that was not taken */
    rig_block(false);
    wait_ms(5);
    TEST_ASSERT_EQUAL_UINT(1, rig_sent_count());
    assert_sent(0, DRIVE, 2);
}

TEST(waiting_frames_leave_during_a_receive)
{
    rig_block(true);
    TEST_ASSERT_GREATER_THAN_UINT(8, fill_up());
    rig_block(false);
    wait_ms(5);
    for (uint8_t n = 0; n < 9; n++)
        assert_sent(n, HEARTBEAT, n);
}

/* What every CAN controller's driver has to do, with the link on top of it: trouble on the bus. Built once with each rig. */

TEST(bus_not_yet_joined_is_down)
{
    struct frame frame;

    rig_reset();
    rig_block(true);
    TEST_ASSERT_EQUAL(0, open_link());
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_EQUAL(LINK_E_DOWN, try_to_send(0x100, 0));
    rig_block(false);
    wait_ms(WAIT_MS);
}

TEST(bus_off_is_down_for_the_time_asked)
{
    struct frame frame;
    uint32_t start;

    rig_enter_bus_off();
    rig_block(true);
    start = rig_ms();
    TEST_ASSERT_EQUAL(LINK_E_DOWN, try_to_send(0x100, 0));
    TEST_ASSERT_LESS_THAN_UINT32(start + 5, rig_ms());
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_UINT32_WITHIN(6, start + WAIT_MS, rig_ms());
}

TEST(bus_off_is_recovered_from_and_counted)
{
    struct frame frame;

    rig_enter_bus_off();
    (void)link_receive(link_here, &frame, WAIT_MS);
    TEST_ASSERT_FALSE(rig_is_bus_off());
    TEST_ASSERT_EQUAL_UINT8(1, health_now().bus_offs);
    send_numbered(0x100, 7);
    rig_pass_us(1500);
    assert_sent(0, 0x100, 7);
}

TEST(bus_off_drops_waiting_frames)
{
    struct frame frame;

    rig_block(true);
    for (uint8_t n = 0; n < 5; n++)
        send_numbered(HEARTBEAT, n);
    rig_enter_bus_off();
    rig_block(false);
    (void)link_receive(link_here, &frame, WAIT_MS);
    TEST_ASSERT_EQUAL_UINT(0, rig_sent_count());
    TEST_ASSERT_EQUAL_UINT8(5, health_now().dropped);
}

TEST(lasting_bus_off_is_retried_every_250_ms_and_counted_once)
{
    struct frame frame;
    unsigned before = rig_departures();

    rig_keep_bus_off();
    rig_enter_bus_off();
    (void)link_receive(link_here, &frame, 10 * RECOVERY_MS - 1);
    TEST_ASSERT_EQUAL_UINT(10, rig_departures() - before);
    TEST_ASSERT_EQUAL_UINT8(1, health_now().bus_offs);
}

static void receive_until_departures(unsigned count)
{
    struct frame frame;

    while (rig_departures() < count)
        TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, 0));
}

TEST(bus_off_recovery_is_retried_after_250_ms)
{
    unsigned before = rig_departures();
    struct frame frame;
    uint32_t start;

    rig_keep_bus_off();
    rig_enter_bus_off();
    receive_until_departures(before + 1);
    start = rig_ms();
    receive_until_departures(before + 2);
    TEST_ASSERT_EQUAL_UINT32(start + RECOVERY_MS, rig_ms());
    rig_pass_us(1000 * (RECOVERY_MS + 50));
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, 1));
    TEST_ASSERT_EQUAL_UINT(before + 3, rig_departures());
}

TEST(bus_with_many_errors_is_still_used)
{
    rig_set_errors(100, 100, false);
    send_numbered(HEARTBEAT, 1);
    rig_pass_us(1500);
    assert_sent(0, HEARTBEAT, 1);
}

TEST(bus_off_with_a_dead_controller_stays_bounded)
{
    struct frame frame;
    uint32_t start;

    rig_enter_bus_off();
    rig_stop_answering();
    start = rig_ms();
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_UINT32_WITHIN(5, start + WAIT_MS, rig_ms());
}

TEST(health_counters_stay_at_255)
{
    struct frame frame;

    for (unsigned i = 0; i < 300; i++) {
        rig_block(true);
        send_numbered(HEARTBEAT, 0);
        rig_block(false);
        rig_enter_bus_off();
        (void)link_receive(link_here, &frame, WAIT_MS);
    }
    TEST_ASSERT_EQUAL_UINT8(255, health_now().bus_offs);
    TEST_ASSERT_EQUAL_UINT8(255, health_now().dropped);
}

TEST(health_reports_the_error_counters_of_the_controller)
{
    rig_set_errors(100, 120, false);
    TEST_ASSERT_EQUAL_UINT8(100, health_now().tx_errors);
    TEST_ASSERT_EQUAL_UINT8(120, health_now().rx_errors);
    TEST_ASSERT_EQUAL(BUS_ACTIVE, health_now().state);
    rig_set_errors(100, 120, true);
    TEST_ASSERT_EQUAL(BUS_PASSIVE, health_now().state);
    rig_enter_bus_off();
    TEST_ASSERT_EQUAL(BUS_OFF, health_now().state);
}

TEST(link_close_leaves_the_bus)
{
    link_close(NULL);
    TEST_ASSERT_FALSE(rig_is_off_bus());
    link_close(link_here);
    TEST_ASSERT_TRUE(rig_is_off_bus());
}
