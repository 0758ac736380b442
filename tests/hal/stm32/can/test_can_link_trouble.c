/* What every CAN controller's driver has to do, with the link on top of it: trouble on the bus. Built once with each rig. */
#include "can_link_cases.h"

void setUp(void)
{
    rig_reset();
    TEST_ASSERT_EQUAL(0, open_it());
    rig_pass_us(100);
}

TEST(a_bus_not_yet_joined_is_down)
{
    struct frame frame;

    rig_reset();
    rig_block(true);
    TEST_ASSERT_EQUAL(0, open_it());
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_EQUAL(LINK_E_DOWN, try_to_send(0x100, 0));
    rig_block(false);
    wait_ms(WAIT_MS);
}

TEST(bus_off_is_down_for_the_time_asked)
{
    struct frame frame;
    uint32_t start;

    rig_lose_bus();
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

    rig_lose_bus();
    (void)link_receive(link_here, &frame, WAIT_MS);
    TEST_ASSERT_FALSE(rig_has_lost_bus());
    TEST_ASSERT_EQUAL_UINT8(1, health_now().bus_offs);
    send_numbered(0x100, 7);
    rig_pass_us(1500);
    assert_sent(0, 0x100, 7);
}

TEST(what_waited_when_the_bus_went_off_is_dropped)
{
    struct frame frame;

    rig_block(true);
    for (uint8_t n = 0; n < 5; n++)
        send_numbered(HEARTBEAT, n);
    rig_lose_bus();
    rig_block(false);
    (void)link_receive(link_here, &frame, WAIT_MS);
    TEST_ASSERT_EQUAL_UINT(0, rig_sent_count());
    TEST_ASSERT_EQUAL_UINT8(5, health_now().dropped);
}

TEST(a_bus_that_stays_off_is_tried_again_at_a_measured_pace_and_counted_once)
{
    struct frame frame;
    unsigned before = rig_departures();

    rig_keep_bus_off();
    rig_lose_bus();
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

TEST(the_next_try_comes_a_quarter_of_a_second_after_the_last_or_when_somebody_asks)
{
    unsigned before = rig_departures();
    struct frame frame;
    uint32_t start;

    rig_keep_bus_off();
    rig_lose_bus();
    receive_until_departures(before + 1);
    start = rig_ms();
    receive_until_departures(before + 2);
    TEST_ASSERT_EQUAL_UINT32(start + RECOVERY_MS, rig_ms());
    rig_pass_us(1000 * (RECOVERY_MS + 50));
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, 1));
    TEST_ASSERT_EQUAL_UINT(before + 3, rig_departures());
}

TEST(a_bus_with_many_errors_is_still_used)
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

    rig_lose_bus();
    rig_fall_silent();
    start = rig_ms();
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_UINT32_WITHIN(5, start + WAIT_MS, rig_ms());
}

TEST(counters_stay_at_255)
{
    struct frame frame;

    for (unsigned i = 0; i < 300; i++) {
        rig_block(true);
        send_numbered(HEARTBEAT, 0);
        rig_block(false);
        rig_lose_bus();
        (void)link_receive(link_here, &frame, WAIT_MS);
    }
    TEST_ASSERT_EQUAL_UINT8(255, health_now().bus_offs);
    TEST_ASSERT_EQUAL_UINT8(255, health_now().dropped);
}

TEST(health_tells_the_controllers_own_counters)
{
    rig_set_errors(100, 120, false);
    TEST_ASSERT_EQUAL_UINT8(100, health_now().tx_errors);
    TEST_ASSERT_EQUAL_UINT8(120, health_now().rx_errors);
    TEST_ASSERT_EQUAL(BUS_ACTIVE, health_now().state);
    rig_set_errors(100, 120, true);
    TEST_ASSERT_EQUAL(BUS_PASSIVE, health_now().state);
    rig_lose_bus();
    TEST_ASSERT_EQUAL(BUS_OFF, health_now().state);
}

TEST(a_closed_link_leaves_the_bus_alone)
{
    link_close(NULL);
    TEST_ASSERT_FALSE(rig_is_apart());
    link_close(link_here);
    TEST_ASSERT_TRUE(rig_is_apart());
}
