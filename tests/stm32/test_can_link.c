/* What every CAN controller's driver has to do, with the link on top of it. Built once with each rig. */
#include <string.h>

#include <unity.h>

#include "can_rig.h"
#include "hal/stm32/line.h"

enum { WAIT_MS = 20, RECOVERY_MS = 250, DRIVE = 0x041, ANSWER = 0x141, MEMORY = 0x681, HEARTBEAT = 0x6A1, HEALTH = 0x7C1 };

static const uint16_t WANTED[] = {0x0C1, 0x041};
static struct link *link_here;

static struct frame numbered(uint32_t id, uint8_t number)
{
    return (struct frame){.id = id, .len = 8, .data = {number, 1, 2, 3, 4, 5, 6, 0xF7}};
}

static int open_it(void)
{
    return link_open(&link_here, "", WANTED, 2);
}

void setUp(void)
{
    rig_reset();
    TEST_ASSERT_EQUAL(0, open_it());
    rig_pass_us(100);
}

void tearDown(void) {}

static void assert_frame(const struct frame *expected, const struct frame *actual)
{
    TEST_ASSERT_EQUAL_HEX32(expected->id, actual->id);
    TEST_ASSERT_EQUAL_UINT8(expected->len, actual->len);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected->data, actual->data, 8);
}

static int try_to_send(uint32_t id, uint8_t number)
{
    struct frame frame = numbered(id, number);

    return link_send(link_here, &frame);
}

static void send_numbered(uint32_t id, uint8_t number)
{
    TEST_ASSERT_EQUAL(0, try_to_send(id, number));
}

static void assert_receives(const struct frame *expected)
{
    struct frame frame;

    memset(&frame, 0xEE, sizeof frame);
    TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, WAIT_MS));
    assert_frame(expected, &frame);
}

/* The link is given time to send. */
static void wait_ms(uint32_t ms)
{
    struct frame frame;

    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, ms));
}

static void assert_sent(unsigned n, uint32_t id, uint8_t number)
{
    TEST_ASSERT_LESS_THAN_UINT(rig_sent_count(), n);
    TEST_ASSERT_EQUAL_HEX32(id, rig_sent(n)->id);
    TEST_ASSERT_EQUAL_UINT8(number, rig_sent(n)->data[0]);
}

static struct link_health health(void)
{
    struct link_health health;

    link_health(link_here, &health);
    return health;
}

/* ---- opening */

static void test_the_bit_rate_is_500_kbit_s_from_every_clock_it_may_run_at(void)
{
    for (const uint32_t *hz = RIG_CLOCKS_HZ; *hz != 0; hz++) {
        struct rig_bit bit;

        rig_reset();
        rig_set_clock(*hz);
        TEST_ASSERT_EQUAL(0, open_it());
        bit = rig_bit();
        TEST_ASSERT_EQUAL_UINT32(*hz, 500000 * bit.prescaler * (bit.before + bit.after));
        TEST_ASSERT_UINT32_WITHIN(25, 875, 1000 * bit.before / (bit.before + bit.after));   /* sample point, in 1/1000 */
        TEST_ASSERT_EQUAL_UINT32(2, bit.jump);                                              /* and no test mode beside it */
    }
}

static void test_a_clock_without_a_divisor_for_500_kbit_s_does_not_open(void)
{
    rig_reset();
    rig_set_clock(36000000 + 500);
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
    rig_set_clock(3000000);
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
}

static void test_a_controller_that_does_not_answer_is_given_up_soon(void)
{
    rig_reset();
    rig_fall_silent();
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
    TEST_ASSERT_LESS_THAN_UINT32(5, rig_ms());
}

static void test_the_filters_pass_what_is_wanted_and_nothing_else(void)
{
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == WANTED[0] || id == WANTED[1] ? 0 : -1, rig_fifo_for(id));
}

static void open_family(void)
{
    static const uint16_t ids[] = {0x0C1, LINK_FAMILY | 0x680};

    rig_reset();
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, 2));
    rig_pass_us(100);
}

static void test_a_family_is_let_through_whole_and_waits_apart(void)
{
    open_family();
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == 0x0C1 ? 0 : id >= 0x680 && id <= 0x69F ? 1 : -1, rig_fifo_for(id));
}

static void test_the_filters_hold_eight_identifiers_and_not_nine(void)
{
    static const uint16_t ids[] = {1, 2, 3, 4, 5, 6, 7, 0x7FF, 9};

    rig_reset();
    TEST_ASSERT_EQUAL(LINK_E_OPEN, link_open(&link_here, "", ids, 9));
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, LINK_IDS_MAX));
    rig_pass_us(100);
    for (unsigned i = 0; i < 9; i++)
        TEST_ASSERT_EQUAL(i < 8 ? 0 : -1, rig_fifo_for(ids[i]));
}

/* ---- sending */

static void test_a_frame_goes_out_as_it_is(void)
{
    struct frame frame = {.id = 0x7A5, .len = 3, .data = {0x11, 0x82, 0xF3}};

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
    rig_pass_us(1500);
    TEST_ASSERT_EQUAL_UINT(1, rig_sent_count());
    assert_frame(&frame, rig_sent(0));
}

/* All that a robot tells of itself when it is asked: nothing is lost, and the drive is the last. */
static void test_on_an_idle_bus_frames_leave_in_the_order_sent(void)
{
    static const uint32_t ids[] = {ANSWER, HEARTBEAT, MEMORY, MEMORY, 0x781, 0x781, 0x7A1, HEALTH, DRIVE};
    enum { COUNT = sizeof ids / sizeof ids[0] };

    for (uint8_t n = 0; n < COUNT; n++)
        send_numbered(ids[n], n);
    wait_ms(WAIT_MS);
    TEST_ASSERT_EQUAL_UINT(COUNT, rig_sent_count());
    for (uint8_t n = 0; n < COUNT; n++)
        assert_sent(n, ids[n], n);
    TEST_ASSERT_EQUAL_UINT8(0, health().dropped);
}

static void test_frames_of_one_identifier_never_overtake_each_other(void)
{
    rig_block(true);
    for (uint8_t n = 0; n < 8; n++)
        send_numbered(DRIVE, n);
    rig_block(false);
    wait_ms(5);
    for (uint8_t n = 0; n < 8; n++)
        assert_sent(n, DRIVE, n);
    TEST_ASSERT_EQUAL_UINT8(0, health().dropped);
}

/* Others have all of the bus that identifiers like theirs can have. */
static void test_a_drive_leaves_at_once_whatever_else_waits(void)
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

static void test_what_is_urgent_takes_the_place_of_what_is_least_so(void)
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
    TEST_ASSERT_EQUAL_UINT8(1, health().dropped);
}

static void test_what_is_less_urgent_than_what_waits_stays_behind_it(void)
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

static void test_a_controller_that_sticks_is_given_up_in_time(void)
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

/* Sends until no more is taken; returns how many were. */
static unsigned fill_up(void)
{
    unsigned count = 0;

    while (try_to_send(HEARTBEAT, (uint8_t)count) == 0)
        TEST_ASSERT_LESS_THAN_UINT(100, ++count);
    return count;
}

static void test_a_bus_that_takes_nothing_is_waited_for_no_longer_than_promised(void)
{
    uint32_t start;

    rig_block(true);
    TEST_ASSERT_GREATER_THAN_UINT(8, fill_up());
    start = rig_ms();
    TEST_ASSERT_EQUAL(LINK_E_FULL, try_to_send(HEARTBEAT, 0));
    TEST_ASSERT_EQUAL(0, try_to_send(DRIVE, 0));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(start + 2 * LINK_SEND_MS, rig_ms());
    TEST_ASSERT_EQUAL_UINT8(2, health().dropped);
}

static void test_what_no_bus_takes_is_dropped_and_counted_and_the_newest_drive_leaves(void)
{
    unsigned count;

    rig_block(true);
    count = fill_up();
    send_numbered(DRIVE, 1);
    wait_ms(20);
    send_numbered(DRIVE, 2);
    TEST_ASSERT_EQUAL_UINT8(count + 2, health().dropped);   /* the first drive, and one more that was not taken */
    rig_block(false);
    wait_ms(5);
    TEST_ASSERT_EQUAL_UINT(1, rig_sent_count());
    assert_sent(0, DRIVE, 2);
}

static void test_what_waits_leaves_while_the_robot_listens(void)
{
    rig_block(true);
    TEST_ASSERT_GREATER_THAN_UINT(8, fill_up());
    rig_block(false);
    wait_ms(5);
    for (uint8_t n = 0; n < 9; n++)
        assert_sent(n, HEARTBEAT, n);
}

/* ---- receiving */

static void test_a_frame_comes_in_as_it_is(void)
{
    struct frame frame = numbered(0x0C1, 9);

    rig_bring(&frame);
    assert_receives(&frame);
}

static void test_frames_come_in_their_order_and_once(void)
{
    for (uint8_t n = 0; n < 3; n++)
        rig_bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    for (uint8_t n = 0; n < 3; n++)
        assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    wait_ms(1);
}

static void test_bytes_beyond_the_length_are_zero(void)
{
    rig_bring(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2}});
}

static void test_a_length_beyond_8_means_8(void)
{
    struct frame frame = numbered(0x0C1, 0);

    frame.len = 15;
    rig_bring(&frame);
    frame.len = 8;
    assert_receives(&frame);
}

static void test_extended_and_remote_frames_are_told_apart(void)
{
    rig_open_filters();
    rig_bring(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    rig_bring(&(struct frame){.id = FRAME_REMOTE | 0x0C1});
    assert_receives(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    assert_receives(&(struct frame){.id = FRAME_REMOTE | 0x0C1});
}

static void test_silence_is_waited_out(void)
{
    uint32_t start = rig_ms();

    wait_ms(WAIT_MS);
    TEST_ASSERT_UINT32_WITHIN(1, WAIT_MS, rig_ms() - start);
}

/* Which of them are lost is the controller's business. */
static void test_lost_frames_are_said_once_and_the_others_come(void)
{
    struct frame frame;

    for (uint8_t n = 0; n < 5; n++)
        rig_bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, link_receive(link_here, &frame, 0));
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {0}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {1}});
    TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, 0));
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 0));
}

static void test_a_family_that_overruns_pushes_out_nothing_else(void)
{
    struct frame frame;

    open_family();
    for (uint8_t n = 0; n < 5; n++)
        rig_bring(&(struct frame){.id = 0x681u + n, .len = 1});
    rig_bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {7}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {7}});
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, link_receive(link_here, &frame, 0));
    assert_receives(&(struct frame){.id = 0x681, .len = 1});
}

static void test_there_is_nothing_to_pump(void)
{
    line_pump();
    TEST_ASSERT_EQUAL_UINT(0, rig_sent_count());
}

/* ---- trouble on the bus */

static void test_a_bus_not_yet_joined_is_down(void)
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

static void test_bus_off_is_down_for_the_time_asked(void)
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

static void test_bus_off_is_recovered_from_and_counted(void)
{
    struct frame frame;

    rig_lose_bus();
    (void)link_receive(link_here, &frame, WAIT_MS);
    TEST_ASSERT_FALSE(rig_has_lost_bus());
    TEST_ASSERT_EQUAL_UINT8(1, health().bus_offs);
    send_numbered(0x100, 7);
    rig_pass_us(1500);
    assert_sent(0, 0x100, 7);
}

static void test_what_waited_when_the_bus_went_off_is_dropped(void)
{
    struct frame frame;

    rig_block(true);
    for (uint8_t n = 0; n < 5; n++)
        send_numbered(HEARTBEAT, n);
    rig_lose_bus();
    rig_block(false);
    (void)link_receive(link_here, &frame, WAIT_MS);
    TEST_ASSERT_EQUAL_UINT(0, rig_sent_count());
    TEST_ASSERT_EQUAL_UINT8(5, health().dropped);
}

static void test_a_bus_that_stays_off_is_tried_again_at_a_measured_pace_and_counted_once(void)
{
    struct frame frame;
    unsigned before = rig_departures();

    rig_keep_bus_off();
    rig_lose_bus();
    (void)link_receive(link_here, &frame, 10 * RECOVERY_MS - 1);
    TEST_ASSERT_EQUAL_UINT(10, rig_departures() - before);
    TEST_ASSERT_EQUAL_UINT8(1, health().bus_offs);
}

static void test_bus_off_with_a_dead_controller_stays_bounded(void)
{
    struct frame frame;
    uint32_t start;

    rig_lose_bus();
    rig_fall_silent();
    start = rig_ms();
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_UINT32_WITHIN(5, start + WAIT_MS, rig_ms());
}

static void test_counters_stay_at_255(void)
{
    struct frame frame;

    for (unsigned i = 0; i < 300; i++) {
        rig_block(true);
        send_numbered(HEARTBEAT, 0);
        rig_block(false);
        rig_lose_bus();
        (void)link_receive(link_here, &frame, WAIT_MS);
    }
    TEST_ASSERT_EQUAL_UINT8(255, health().bus_offs);
    TEST_ASSERT_EQUAL_UINT8(255, health().dropped);
}

static void test_health_tells_the_controllers_own_counters(void)
{
    rig_set_errors(100, 120, false);
    TEST_ASSERT_EQUAL_UINT8(100, health().tx_errors);
    TEST_ASSERT_EQUAL_UINT8(120, health().rx_errors);
    TEST_ASSERT_EQUAL(BUS_ACTIVE, health().state);
    rig_set_errors(100, 120, true);
    TEST_ASSERT_EQUAL(BUS_PASSIVE, health().state);
    rig_lose_bus();
    TEST_ASSERT_EQUAL(BUS_OFF, health().state);
}

static void test_a_closed_link_leaves_the_bus_alone(void)
{
    link_close(NULL);
    TEST_ASSERT_FALSE(rig_is_apart());
    link_close(link_here);
    TEST_ASSERT_TRUE(rig_is_apart());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_bit_rate_is_500_kbit_s_from_every_clock_it_may_run_at);
    RUN_TEST(test_a_clock_without_a_divisor_for_500_kbit_s_does_not_open);
    RUN_TEST(test_a_controller_that_does_not_answer_is_given_up_soon);
    RUN_TEST(test_the_filters_pass_what_is_wanted_and_nothing_else);
    RUN_TEST(test_a_family_is_let_through_whole_and_waits_apart);
    RUN_TEST(test_the_filters_hold_eight_identifiers_and_not_nine);
    RUN_TEST(test_a_frame_goes_out_as_it_is);
    RUN_TEST(test_on_an_idle_bus_frames_leave_in_the_order_sent);
    RUN_TEST(test_frames_of_one_identifier_never_overtake_each_other);
    RUN_TEST(test_a_drive_leaves_at_once_whatever_else_waits);
    RUN_TEST(test_what_is_urgent_takes_the_place_of_what_is_least_so);
    RUN_TEST(test_what_is_less_urgent_than_what_waits_stays_behind_it);
    RUN_TEST(test_a_controller_that_sticks_is_given_up_in_time);
    RUN_TEST(test_a_bus_that_takes_nothing_is_waited_for_no_longer_than_promised);
    RUN_TEST(test_what_no_bus_takes_is_dropped_and_counted_and_the_newest_drive_leaves);
    RUN_TEST(test_what_waits_leaves_while_the_robot_listens);
    RUN_TEST(test_a_frame_comes_in_as_it_is);
    RUN_TEST(test_frames_come_in_their_order_and_once);
    RUN_TEST(test_bytes_beyond_the_length_are_zero);
    RUN_TEST(test_a_length_beyond_8_means_8);
    RUN_TEST(test_extended_and_remote_frames_are_told_apart);
    RUN_TEST(test_silence_is_waited_out);
    RUN_TEST(test_lost_frames_are_said_once_and_the_others_come);
    RUN_TEST(test_a_family_that_overruns_pushes_out_nothing_else);
    RUN_TEST(test_there_is_nothing_to_pump);
    RUN_TEST(test_a_bus_not_yet_joined_is_down);
    RUN_TEST(test_bus_off_is_down_for_the_time_asked);
    RUN_TEST(test_bus_off_is_recovered_from_and_counted);
    RUN_TEST(test_what_waited_when_the_bus_went_off_is_dropped);
    RUN_TEST(test_a_bus_that_stays_off_is_tried_again_at_a_measured_pace_and_counted_once);
    RUN_TEST(test_bus_off_with_a_dead_controller_stays_bounded);
    RUN_TEST(test_counters_stay_at_255);
    RUN_TEST(test_health_tells_the_controllers_own_counters);
    RUN_TEST(test_a_closed_link_leaves_the_bus_alone);
    return UNITY_END();
}
