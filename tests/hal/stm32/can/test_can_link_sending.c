/* What every CAN controller's driver has to do, with the link on top of it: sending. Built once with each rig. */
#include "can_link_cases.h"

void setUp(void)
{
    rig_reset();
    TEST_ASSERT_EQUAL(0, open_it());
    rig_pass_us(100);
}

TEST(a_frame_goes_out_as_it_is)
{
    struct frame frame = {.id = 0x7A5, .len = 3, .data = {0x11, 0x82, 0xF3}};

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
    rig_pass_us(1500);
    TEST_ASSERT_EQUAL_UINT(1, rig_sent_count());
    assert_frame(&frame, rig_sent(0));
}

TEST(all_eight_bytes_go_out_in_their_order)
{
    struct frame frame = {.id = 0x001, .len = 8, .data = {0x81, 0x92, 0xA3, 0xB4, 0xC5, 0xD6, 0xE7, 0xF8}};

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
    rig_pass_us(1500);
    assert_frame(&frame, rig_sent(0));
}

/* All that a robot tells of itself when it is asked: nothing is lost, and the drive is the last. */
TEST(on_an_idle_bus_frames_leave_in_the_order_sent)
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

TEST(frames_of_one_identifier_never_overtake_each_other)
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

/* Others have all of the bus that identifiers like theirs can have. */
TEST(a_drive_leaves_at_once_whatever_else_waits)
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

TEST(what_is_urgent_takes_the_place_of_what_is_least_so)
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

TEST(what_is_less_urgent_than_what_waits_stays_behind_it)
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

TEST(a_controller_that_sticks_is_given_up_in_time)
{
    uint32_t start;

    rig_stick();
    send_numbered(HEALTH, 0);
    send_numbered(HEARTBEAT, 1);
    send_numbered(ANSWER, 2);
    start = rig_ms();
    TEST_ASSERT_EQUAL(LINK_E_FULL, try_to_send(DRIVE, 3));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + LINK_SEND_MS + 6, rig_ms());
}

TEST(a_bus_that_takes_nothing_is_waited_for_no_longer_than_promised)
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

TEST(what_no_bus_takes_is_dropped_and_counted_and_the_newest_drive_leaves)
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

TEST(what_waits_leaves_while_the_robot_listens)
{
    rig_block(true);
    TEST_ASSERT_GREATER_THAN_UINT(8, fill_up());
    rig_block(false);
    wait_ms(5);
    for (uint8_t n = 0; n < 9; n++)
        assert_sent(n, HEARTBEAT, n);
}
