#include <stddef.h>
#include <string.h>

#include <unity.h>

#include "bxcan_registers.h"
#include "hal/stm32/line.h"
#include "hal/stm32/registers.h"

enum { WAIT_MS = 20, RECOVERY_MS = 250 };

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
    registers_reset();
    TEST_ASSERT_EQUAL(0, open_it());
    registers_pass_us(100);
}

void tearDown(void) {}

static uint32_t ms(void)
{
    return (uint32_t)(wire.now_ns / 1000000);
}

/* A frame arrives over the wire. */
static void bring(const struct frame *frame)
{
    TEST_ASSERT_TRUE(wire_put(&wire, frame));
    registers_pass_us(300);
}

static bool passes_filters(uint32_t id)
{
    struct frame frame = {.id = id};

    return bxcan_fifo_for(&can, &frame) == 0;
}

static void open_filters(void)
{
    can.filters.words[1] = 0;                           /* FM1R: a mask ... */
    can.filters.banks[0] = can.filters.banks[1] = 0;    /* ... that asks for nothing */
}

static void assert_frame(const struct frame *expected, const struct frame *actual)
{
    TEST_ASSERT_EQUAL_HEX32(expected->id, actual->id);
    TEST_ASSERT_EQUAL_UINT8(expected->len, actual->len);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected->data, actual->data, 8);
}

static void send_numbered(uint32_t id, uint8_t number)
{
    struct frame frame = numbered(id, number);

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
}

static void assert_receives(const struct frame *expected)
{
    struct frame frame;

    memset(&frame, 0xEE, sizeof frame);
    TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, WAIT_MS));
    assert_frame(expected, &frame);
}

static struct link_health health(void)
{
    struct link_health health;

    link_health(link_here, &health);
    return health;
}

/* ---- the registers */

static void test_the_registers_lie_where_the_manual_has_them(void)
{
    TEST_ASSERT_EQUAL_HEX(0x01C, offsetof(struct can_registers, btr));
    TEST_ASSERT_EQUAL_HEX(0x180, offsetof(struct can_registers, sent));
    TEST_ASSERT_EQUAL_HEX(0x1B0, offsetof(struct can_registers, received));
    TEST_ASSERT_EQUAL_HEX(0x200, offsetof(struct can_registers, fmr));
    TEST_ASSERT_EQUAL_HEX(0x204, offsetof(struct can_registers, fm1r));
    TEST_ASSERT_EQUAL_HEX(0x20C, offsetof(struct can_registers, fs1r));
    TEST_ASSERT_EQUAL_HEX(0x214, offsetof(struct can_registers, ffa1r));
    TEST_ASSERT_EQUAL_HEX(0x21C, offsetof(struct can_registers, fa1r));
    TEST_ASSERT_EQUAL_HEX(0x240, offsetof(struct can_registers, bank));
}

/* ---- opening */

static void test_the_bit_rate_is_500_kbit_s_from_every_clock_we_may_run_at(void)
{
    static const uint32_t clocks[] = {42000000, 36000000, 32000000, 16000000, 8000000};

    for (unsigned i = 0; i < sizeof clocks / sizeof clocks[0]; i++) {
        registers_reset();
        machine.can_hz = clocks[i];
        TEST_ASSERT_EQUAL(0, open_it());
        uint32_t prescaler = (CAN1.btr & 0x3FFu) + 1, before = (CAN1.btr >> 16 & 15u) + 2, after = (CAN1.btr >> 20 & 7u) + 1;
        TEST_ASSERT_EQUAL_UINT32(clocks[i], 500000 * prescaler * (before + after));
        TEST_ASSERT_UINT32_WITHIN(25, 875, 1000 * before / (before + after));   /* the sample point, in 1/1000 */
        TEST_ASSERT_EQUAL_UINT32(1, CAN1.btr >> 24);                            /* two quanta to jump, no test mode */
    }
}

static void test_a_clock_without_a_divisor_for_500_kbit_s_does_not_open(void)
{
    registers_reset();
    machine.can_hz = 36000000 + 500;
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
    machine.can_hz = 3000000;
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
}

static void test_a_controller_that_does_not_answer_is_given_up_soon(void)
{
    registers_reset();
    can.init_stuck = true;
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
    TEST_ASSERT_LESS_THAN_UINT32(5, ms());
}

static void test_it_wakes_up_and_frames_leave_in_the_order_of_request(void)
{
    TEST_ASSERT_EQUAL_HEX32(4, CAN1.mcr);
}

static void test_the_filters_pass_what_is_wanted_and_nothing_else(void)
{
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == WANTED[0] || id == WANTED[1], passes_filters(id));
}

static void test_the_filters_hold_eight_identifiers_and_not_nine(void)
{
    static const uint16_t ids[] = {1, 2, 3, 4, 5, 6, 7, 0x7FF, 9};

    registers_reset();
    TEST_ASSERT_EQUAL(LINK_E_OPEN, link_open(&link_here, "", ids, 9));
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, LINK_IDS_MAX));
    registers_pass_us(100);
    for (unsigned i = 0; i < 9; i++)
        TEST_ASSERT_EQUAL(i < 8, passes_filters(ids[i]));
}

/* ---- sending */

static void test_a_frame_goes_out_as_it_is(void)
{
    struct frame frame = {.id = 0x7A5, .len = 3, .data = {0x11, 0x82, 0xF3}};

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
    registers_pass_us(1500);
    TEST_ASSERT_EQUAL_UINT(1, wire.heard.count);
    assert_frame(&frame, &wire.heard.frames[0]);
}

static void test_mailboxes_are_written_whole(void)
{
    send_numbered(0x7A5, 0);
    TEST_ASSERT_EQUAL_HEX32(0x7A5u << 21 | 1u, CAN1.sent[0].id);
    TEST_ASSERT_EQUAL_HEX32(8, CAN1.sent[0].length);
}

static void test_frames_that_had_to_wait_leave_in_the_order_sent(void)
{
    wire.busy = true;
    send_numbered(0x300, 0);
    send_numbered(0x100, 1);
    wire.busy = false;
    registers_pass_us(1500);
    wire.busy = true;
    for (uint8_t n = 2; n < 5; n++)
        send_numbered(0x200, n);
    wire.busy = false;
    registers_pass_us(1500);
    for (uint8_t n = 0; n < 5; n++)
        TEST_ASSERT_EQUAL_UINT8(n, wire.heard.frames[n].data[0]);
}

static void fill_mailboxes(void)
{
    wire.busy = true;
    for (uint8_t n = 0; n < 3; n++)
        send_numbered(0x100, n);
}

static void test_a_full_controller_is_waited_for_and_no_longer_than_promised(void)
{
    struct frame frame = numbered(0x100, 3);
    uint32_t start;

    fill_mailboxes();
    start = ms();
    TEST_ASSERT_EQUAL(LINK_E_FULL, link_send(link_here, &frame));
    TEST_ASSERT_UINT32_WITHIN(1, LINK_SEND_MS + 1, ms() - start);
}

static void test_frames_that_do_not_leave_are_dropped_and_counted(void)
{
    struct frame frame = numbered(0x100, 3);

    fill_mailboxes();
    (void)link_send(link_here, &frame);
    registers_pass_us(1500);
    TEST_ASSERT_EQUAL_HEX32(7, CAN1.tsr >> 26 & 7u);   /* all mailboxes are free */
    TEST_ASSERT_EQUAL_UINT8(3, health().dropped);
    wire.busy = false;
    send_numbered(0x100, 4);
    registers_pass_us(1500);
    TEST_ASSERT_EQUAL_UINT(1, wire.heard.count);
    TEST_ASSERT_EQUAL_UINT8(4, wire.heard.frames[0].data[0]);
}

/* ---- receiving */

static void test_a_frame_comes_in_as_it_is(void)
{
    struct frame frame = numbered(0x0C1, 9);

    bring(&frame);
    assert_receives(&frame);
}

static void test_frames_come_in_their_order_and_once(void)
{
    struct frame frame;

    for (uint8_t n = 0; n < 3; n++)
        bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    for (uint8_t n = 0; n < 3; n++)
        assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 1));
}

static void test_a_frame_being_released_does_not_come_twice(void)
{
    struct frame frame;

    can.release_slow = true;
    bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {1}});
    bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {2}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {1}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {2}});
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 1));
}

static void test_no_interrupt_is_asked_for(void)
{
    TEST_ASSERT_EQUAL_HEX32(0, CAN1.ier);
}

static void test_bytes_beyond_the_length_are_zero(void)
{
    bring(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2}});
}

static void test_a_length_beyond_8_means_8(void)
{
    struct frame frame = numbered(0x0C1, 0);

    frame.len = 15;
    bring(&frame);
    frame.len = 8;
    assert_receives(&frame);
}

static void test_extended_and_remote_frames_are_told_apart(void)
{
    open_filters();
    bring(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    bring(&(struct frame){.id = FRAME_REMOTE | 0x0C1});
    assert_receives(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    assert_receives(&(struct frame){.id = FRAME_REMOTE | 0x0C1});
}

static void test_silence_is_waited_out(void)
{
    struct frame frame;
    uint32_t start = ms();

    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_UINT32_WITHIN(1, WAIT_MS, ms() - start);
}

static void test_a_lost_frame_is_said_once_and_the_others_come(void)
{
    struct frame frame;

    for (uint8_t n = 0; n < 5; n++)
        bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, link_receive(link_here, &frame, 0));
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {0}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {1}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {4}});   /* it took the place of those before */
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 0));
}

static void test_there_is_nothing_to_pump(void)
{
    line_pump();
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
}

/* ---- trouble on the bus */

static void test_a_bus_not_yet_joined_is_down(void)
{
    struct frame frame = numbered(0x100, 0);

    registers_reset();
    wire.busy = true;
    TEST_ASSERT_EQUAL(0, open_it());
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_send(link_here, &frame));
    wire.busy = false;
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, WAIT_MS));
}

static void go_bus_off(void)
{
    can.bus_off = true;
    registers_pass_us(0);
}

static void test_bus_off_is_down_for_the_time_asked(void)
{
    struct frame frame = numbered(0x100, 0);
    uint32_t start;

    go_bus_off();
    wire.busy = true;
    start = ms();
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_send(link_here, &frame));
    TEST_ASSERT_LESS_THAN_UINT32(start + 5, ms());
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_UINT32_WITHIN(6, start + WAIT_MS, ms());
}

static void test_bus_off_is_recovered_from_and_counted(void)
{
    struct frame frame;

    go_bus_off();
    (void)link_receive(link_here, &frame, WAIT_MS);
    TEST_ASSERT_FALSE(can.bus_off);
    TEST_ASSERT_EQUAL_UINT8(1, health().bus_offs);
    send_numbered(0x100, 7);
    registers_pass_us(1500);
    TEST_ASSERT_EQUAL_UINT8(7, wire.heard.frames[0].data[0]);
}

static void test_what_waited_when_the_bus_went_off_is_dropped(void)
{
    struct frame frame;

    fill_mailboxes();
    go_bus_off();
    wire.busy = false;
    (void)link_receive(link_here, &frame, WAIT_MS);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
    TEST_ASSERT_EQUAL_UINT8(3, health().dropped);
}

static void test_a_bus_that_stays_off_is_tried_again_at_a_measured_pace_and_counted_once(void)
{
    struct frame frame;
    unsigned before = can.inits;

    can.recovery_stuck = true;
    go_bus_off();
    (void)link_receive(link_here, &frame, 10 * RECOVERY_MS - 1);
    TEST_ASSERT_EQUAL_UINT(10, can.inits - before);
    TEST_ASSERT_EQUAL_UINT8(1, health().bus_offs);
}

static void test_bus_off_with_a_dead_controller_stays_bounded(void)
{
    struct frame frame;
    uint32_t start;

    go_bus_off();
    can.init_stuck = true;
    start = ms();
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_UINT32_WITHIN(5, start + WAIT_MS, ms());
}

static void test_counters_stay_at_255(void)
{
    struct frame frame;

    for (unsigned i = 0; i < 300; i++) {
        go_bus_off();
        (void)link_receive(link_here, &frame, WAIT_MS);
    }
    TEST_ASSERT_EQUAL_UINT8(255, health().bus_offs);
}

static void test_health_tells_the_controllers_own_counters(void)
{
    can.tec = 100;
    can.rec = 120;
    registers_pass_us(0);
    TEST_ASSERT_EQUAL_UINT8(100, health().tx_errors);
    TEST_ASSERT_EQUAL_UINT8(120, health().rx_errors);
    TEST_ASSERT_EQUAL(BUS_ACTIVE, health().state);
    can.rec = 128;
    registers_pass_us(0);
    TEST_ASSERT_EQUAL(BUS_PASSIVE, health().state);
    can.bus_off = true;
    registers_pass_us(0);
    TEST_ASSERT_EQUAL(BUS_OFF, health().state);
}

static void test_a_closed_link_leaves_the_bus_alone(void)
{
    link_close(NULL);
    TEST_ASSERT_EQUAL_HEX32(0, CAN1.msr & 1u);
    link_close(link_here);
    TEST_ASSERT_EQUAL_HEX32(1, CAN1.msr & 1u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_registers_lie_where_the_manual_has_them);
    RUN_TEST(test_the_bit_rate_is_500_kbit_s_from_every_clock_we_may_run_at);
    RUN_TEST(test_a_clock_without_a_divisor_for_500_kbit_s_does_not_open);
    RUN_TEST(test_a_controller_that_does_not_answer_is_given_up_soon);
    RUN_TEST(test_it_wakes_up_and_frames_leave_in_the_order_of_request);
    RUN_TEST(test_the_filters_pass_what_is_wanted_and_nothing_else);
    RUN_TEST(test_the_filters_hold_eight_identifiers_and_not_nine);
    RUN_TEST(test_a_frame_goes_out_as_it_is);
    RUN_TEST(test_mailboxes_are_written_whole);
    RUN_TEST(test_frames_that_had_to_wait_leave_in_the_order_sent);
    RUN_TEST(test_a_full_controller_is_waited_for_and_no_longer_than_promised);
    RUN_TEST(test_frames_that_do_not_leave_are_dropped_and_counted);
    RUN_TEST(test_a_frame_comes_in_as_it_is);
    RUN_TEST(test_frames_come_in_their_order_and_once);
    RUN_TEST(test_a_frame_being_released_does_not_come_twice);
    RUN_TEST(test_no_interrupt_is_asked_for);
    RUN_TEST(test_bytes_beyond_the_length_are_zero);
    RUN_TEST(test_a_length_beyond_8_means_8);
    RUN_TEST(test_extended_and_remote_frames_are_told_apart);
    RUN_TEST(test_silence_is_waited_out);
    RUN_TEST(test_a_lost_frame_is_said_once_and_the_others_come);
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
