#include <stddef.h>
#include <string.h>

#include <unity.h>

#include "fdcan_model.h"
#include "hal/stm32/fdcan_registers.h"
#include "hal/stm32/line.h"

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
    fdcan_reset();
    TEST_ASSERT_EQUAL(0, open_it());
    fdcan_step();
}

void tearDown(void) {}

static uint32_t ms(void)
{
    return fdcan.now_us / 1000;
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

/* ---- the registers and the message RAM */

static void test_the_registers_lie_where_the_manual_has_them(void)
{
    TEST_ASSERT_EQUAL_HEX(0x018, offsetof(struct fdcan_registers, cccr));
    TEST_ASSERT_EQUAL_HEX(0x01C, offsetof(struct fdcan_registers, nbtp));
    TEST_ASSERT_EQUAL_HEX(0x040, offsetof(struct fdcan_registers, ecr));
    TEST_ASSERT_EQUAL_HEX(0x044, offsetof(struct fdcan_registers, psr));
    TEST_ASSERT_EQUAL_HEX(0x050, offsetof(struct fdcan_registers, ir));
    TEST_ASSERT_EQUAL_HEX(0x05C, offsetof(struct fdcan_registers, ile));
    TEST_ASSERT_EQUAL_HEX(0x080, offsetof(struct fdcan_registers, rxgfc));
    TEST_ASSERT_EQUAL_HEX(0x090, offsetof(struct fdcan_registers, rxf0s));
    TEST_ASSERT_EQUAL_HEX(0x094, offsetof(struct fdcan_registers, rxf0a));
    TEST_ASSERT_EQUAL_HEX(0x0C0, offsetof(struct fdcan_registers, txbc));
    TEST_ASSERT_EQUAL_HEX(0x0C4, offsetof(struct fdcan_registers, txfqs));
    TEST_ASSERT_EQUAL_HEX(0x0C8, offsetof(struct fdcan_registers, txbrp));
    TEST_ASSERT_EQUAL_HEX(0x0CC, offsetof(struct fdcan_registers, txbar));
    TEST_ASSERT_EQUAL_HEX(0x0D0, offsetof(struct fdcan_registers, txbcr));
    TEST_ASSERT_EQUAL_HEX(0x0E8, offsetof(struct fdcan_registers, txefa));
}

static void test_the_message_ram_is_laid_out_as_the_manual_has_it(void)
{
    TEST_ASSERT_EQUAL_HEX(0x070, offsetof(struct fdcan_ram, extended_filters));
    TEST_ASSERT_EQUAL_HEX(0x0B0, offsetof(struct fdcan_ram, received_0));
    TEST_ASSERT_EQUAL_HEX(0x188, offsetof(struct fdcan_ram, received_1));
    TEST_ASSERT_EQUAL_HEX(0x260, offsetof(struct fdcan_ram, events));
    TEST_ASSERT_EQUAL_HEX(0x278, offsetof(struct fdcan_ram, sent));
    TEST_ASSERT_EQUAL_HEX(0x350, sizeof(struct fdcan_ram));
}

/* ---- opening */

static void test_the_bit_rate_is_500_kbit_s_from_every_clock_we_may_run_at(void)
{
    static const uint32_t clocks[] = {80000000, 16000000};

    for (unsigned i = 0; i < sizeof clocks / sizeof clocks[0]; i++) {
        fdcan_reset();
        fdcan.clocks.can_hz = clocks[i];
        TEST_ASSERT_EQUAL(0, open_it());
        uint32_t prescaler = (FDCAN.nbtp >> 16 & 0x1FFu) + 1, before = (FDCAN.nbtp >> 8 & 0xFFu) + 2;
        uint32_t after = (FDCAN.nbtp & 0x7Fu) + 1;
        TEST_ASSERT_EQUAL_UINT32(clocks[i], 500000 * prescaler * (before + after));
        TEST_ASSERT_EQUAL_UINT32(875, 1000 * before / (before + after));   /* the sample point, in 1/1000 */
        TEST_ASSERT_EQUAL_UINT32(1, FDCAN.nbtp >> 25);                     /* two quanta to jump */
    }
}

static void test_a_clock_without_a_divisor_for_500_kbit_s_does_not_open(void)
{
    fdcan_reset();
    fdcan.clocks.can_hz = 80000000 + 500;
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
    fdcan.clocks.can_hz = 3000000;
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
}

static void test_a_controller_that_does_not_answer_is_given_up_soon(void)
{
    fdcan_reset();
    fdcan.ignores_init = true;
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
    TEST_ASSERT_LESS_THAN_UINT32(5, ms());
}

static void test_it_speaks_classic_can_without_test_modes_and_the_lowest_identifier_first(void)
{
    TEST_ASSERT_EQUAL_HEX32(0, FDCAN.cccr);
    TEST_ASSERT_EQUAL_HEX32(1 << 24, FDCAN.txbc);
}

static void test_no_frame_but_those_wanted_gets_in(void)
{
    TEST_ASSERT_EQUAL_HEX32(3 | 2 << 2 | 2 << 4, FDCAN.rxgfc & 0xFFFF);
    TEST_ASSERT_EQUAL_HEX32(0, FDCAN.rxgfc >> 24);   /* no extended filters */
}

static void test_an_odd_number_of_identifiers_fits(void)
{
    static const uint16_t three[] = {0x0C1, 0x041, 0x7FF};

    fdcan_reset();
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", three, 3));
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == 0x0C1 || id == 0x041 || id == 0x7FF, fdcan_filter_passes(id));
}

static void test_the_filters_pass_what_is_wanted_and_nothing_else(void)
{
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == WANTED[0] || id == WANTED[1], fdcan_filter_passes(id));
}

static void test_the_filters_hold_eight_identifiers_and_not_nine(void)
{
    static const uint16_t ids[] = {1, 2, 3, 4, 5, 6, 7, 0x7FF, 9};

    fdcan_reset();
    TEST_ASSERT_EQUAL(LINK_E_OPEN, link_open(&link_here, "", ids, 9));
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, LINK_IDS_MAX));
    for (unsigned i = 0; i < 9; i++)
        TEST_ASSERT_EQUAL(i < 8, fdcan_filter_passes(ids[i]));
}

/* ---- sending */

static void test_a_frame_goes_out_as_it_is(void)
{
    struct frame frame = {.id = 0x7A5, .len = 3, .data = {0x11, 0x82, 0xF3}};

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
    fdcan_step();
    TEST_ASSERT_EQUAL_UINT(1, fdcan.sent_count);
    assert_frame(&frame, &fdcan.sent[0]);
}

static void test_buffers_are_written_whole(void)
{
    send_numbered(0x7A5, 0);
    TEST_ASSERT_EQUAL_HEX32(0x7A5u << 18, FDCAN_RAM.sent[0].id);
    TEST_ASSERT_EQUAL_HEX32(8u << 16, FDCAN_RAM.sent[0].control);
}

static void test_the_lowest_identifier_leaves_first(void)
{
    fdcan.bus_busy = true;
    send_numbered(0x300, 0);
    send_numbered(0x200, 1);
    send_numbered(0x081, 2);
    fdcan.bus_busy = false;
    fdcan_step();
    for (uint8_t n = 0; n < 3; n++)
        TEST_ASSERT_EQUAL_UINT8(2 - n, fdcan.sent[n].data[0]);
}

static void test_the_last_buffer_is_kept_for_what_outranks_the_others(void)
{
    struct frame late = numbered(0x301, 2);

    fdcan.bus_busy = true;
    send_numbered(0x180, 0);
    send_numbered(0x200, 1);
    TEST_ASSERT_EQUAL(LINK_E_FULL, link_send(link_here, &late));
    fdcan_step();
    send_numbered(0x180, 3);
    send_numbered(0x200, 4);
    send_numbered(0x081, 5);
    TEST_ASSERT_EQUAL_HEX32(7, FDCAN.txbrp | FDCAN.txbar);
}

static void test_frames_of_one_identifier_never_overtake_each_other(void)
{
    struct frame second = numbered(0x081, 1);

    fdcan.bus_busy = true;
    send_numbered(0x081, 0);
    TEST_ASSERT_EQUAL(LINK_E_FULL, link_send(link_here, &second));   /* waits for the first, which does not leave */
    fdcan.bus_busy = false;
    for (uint8_t n = 2; n < 10; n++)
        send_numbered(0x081, n);
    fdcan_step();
    for (uint8_t n = 2; n < 10; n++)
        TEST_ASSERT_EQUAL_UINT8(n, fdcan.sent[n - 2].data[0]);
}

static void fill_buffers(void)
{
    fdcan.bus_busy = true;
    for (uint8_t n = 0; n < 3; n++)
        send_numbered(0x300 - 0x100u * n, n);
}

static void test_frames_that_do_not_leave_are_dropped_and_counted(void)
{
    struct frame frame = numbered(0x080, 3);

    fill_buffers();
    (void)link_send(link_here, &frame);
    fdcan_step();
    TEST_ASSERT_EQUAL_UINT(3, fdcan.cancelled);
    TEST_ASSERT_EQUAL_UINT8(3, health().dropped);
    fdcan.bus_busy = false;
    send_numbered(0x100, 4);
    fdcan_step();
    TEST_ASSERT_EQUAL_UINT(1, fdcan.sent_count);
    TEST_ASSERT_EQUAL_UINT8(4, fdcan.sent[0].data[0]);
}

static void test_a_full_controller_is_waited_for_and_no_longer_than_promised(void)
{
    struct frame frame = numbered(0x080, 3);
    uint32_t start;

    fill_buffers();
    start = ms();
    TEST_ASSERT_EQUAL(LINK_E_FULL, link_send(link_here, &frame));
    TEST_ASSERT_UINT32_WITHIN(1, LINK_SEND_MS + 1, ms() - start);
}

/* ---- receiving */

static void test_a_frame_comes_in_as_it_is(void)
{
    struct frame frame = numbered(0x0C1, 9);

    fdcan_bring(&frame);
    assert_receives(&frame);
}

static void test_frames_come_in_their_order_and_once(void)
{
    struct frame frame;

    for (uint8_t n = 0; n < 3; n++)
        fdcan_bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    for (uint8_t n = 0; n < 3; n++)
        assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 1));
}

static void test_the_places_of_the_fifo_are_gone_through_in_a_ring(void)
{
    for (uint8_t n = 0; n < 10; n++) {
        fdcan_bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
        assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    }
}

static void test_no_interrupt_is_asked_for(void)
{
    TEST_ASSERT_EQUAL_HEX32(0, FDCAN.ie | FDCAN.ile);
}

static void test_bytes_beyond_the_length_are_zero(void)
{
    fdcan_bring(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2}});
}

static void test_a_length_beyond_8_means_8(void)
{
    struct frame frame = numbered(0x0C1, 0);

    frame.len = 15;
    fdcan_bring(&frame);
    frame.len = 8;
    assert_receives(&frame);
}

static void test_extended_and_remote_frames_are_told_apart(void)
{
    fdcan_bring(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    fdcan_bring(&(struct frame){.id = FRAME_REMOTE | 0x0C1});
    assert_receives(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    assert_receives(&(struct frame){.id = FRAME_REMOTE | 0x0C1});
}

static void test_a_lost_frame_is_said_once_and_the_others_come(void)
{
    struct frame frame;

    for (uint8_t n = 0; n < 5; n++)
        fdcan_bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, link_receive(link_here, &frame, 0));
    for (uint8_t n = 0; n < 3; n++)
        assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 0));
}

static void test_there_is_nothing_to_pump(void)
{
    line_pump();
    TEST_ASSERT_EQUAL_UINT(0, fdcan.sent_count);
}

/* ---- trouble on the bus */

static void test_a_bus_not_yet_joined_is_down(void)
{
    struct frame frame = numbered(0x100, 0);

    fdcan_reset();
    fdcan.bus_busy = true;
    TEST_ASSERT_EQUAL(0, open_it());
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_send(link_here, &frame));
    fdcan.bus_busy = false;
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, WAIT_MS));
}

static void go_bus_off(void)
{
    fdcan.bus_off = true;
    FDCAN.cccr |= 1u;   /* the controller does that */
    fdcan_step();
}

static void test_bus_off_is_down_for_the_time_asked(void)
{
    struct frame frame = numbered(0x100, 0);
    uint32_t start;

    go_bus_off();
    fdcan.bus_busy = true;
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
    TEST_ASSERT_EQUAL_UINT(1, fdcan.bus_offs_recovered);
    TEST_ASSERT_EQUAL_UINT8(1, health().bus_offs);
    send_numbered(0x100, 7);
    fdcan_step();
    TEST_ASSERT_EQUAL_UINT8(7, fdcan.sent[0].data[0]);
}

static void test_what_waited_when_the_bus_went_off_is_dropped(void)
{
    struct frame frame;

    fill_buffers();
    go_bus_off();
    fdcan.bus_busy = false;
    (void)link_receive(link_here, &frame, WAIT_MS);
    TEST_ASSERT_EQUAL_UINT(0, fdcan.sent_count);
    TEST_ASSERT_EQUAL_UINT8(3, health().dropped);
}

static void test_a_bus_that_stays_off_is_tried_again_at_a_measured_pace_and_counted_once(void)
{
    struct frame frame;
    unsigned before = fdcan.inits;

    fdcan.stays_off = true;
    go_bus_off();
    (void)link_receive(link_here, &frame, 10 * RECOVERY_MS - 1);
    TEST_ASSERT_EQUAL_UINT(10, fdcan.inits - before);
    TEST_ASSERT_EQUAL_UINT8(1, health().bus_offs);
}

static void test_bus_off_with_a_dead_controller_stays_bounded(void)
{
    struct frame frame;
    uint32_t start;

    go_bus_off();
    fdcan.ignores_init = true;
    start = ms();
    TEST_ASSERT_EQUAL(LINK_E_DOWN, link_receive(link_here, &frame, WAIT_MS));
    TEST_ASSERT_UINT32_WITHIN(5, start + WAIT_MS, ms());
}

static void test_health_tells_the_controllers_own_counters(void)
{
    FDCAN.ecr = 0x55u << 16 | 1u << 15 | 100u << 8 | 200u;
    TEST_ASSERT_EQUAL_UINT8(200, health().tx_errors);
    TEST_ASSERT_EQUAL_UINT8(100, health().rx_errors);
    TEST_ASSERT_EQUAL(BUS_ACTIVE, health().state);
    FDCAN.psr |= 1u << 5 | 1u << 6;
    TEST_ASSERT_EQUAL(BUS_PASSIVE, health().state);
    FDCAN.psr |= 1u << 7;
    TEST_ASSERT_EQUAL(BUS_OFF, health().state);
}

static void test_a_closed_link_leaves_the_bus_alone(void)
{
    link_close(NULL);
    TEST_ASSERT_EQUAL_HEX32(0, FDCAN.cccr & 1u);
    link_close(link_here);
    TEST_ASSERT_EQUAL_HEX32(3, FDCAN.cccr);   /* off the bus, and open to be set up */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_registers_lie_where_the_manual_has_them);
    RUN_TEST(test_the_message_ram_is_laid_out_as_the_manual_has_it);
    RUN_TEST(test_the_bit_rate_is_500_kbit_s_from_every_clock_we_may_run_at);
    RUN_TEST(test_a_clock_without_a_divisor_for_500_kbit_s_does_not_open);
    RUN_TEST(test_a_controller_that_does_not_answer_is_given_up_soon);
    RUN_TEST(test_it_speaks_classic_can_without_test_modes_and_the_lowest_identifier_first);
    RUN_TEST(test_no_frame_but_those_wanted_gets_in);
    RUN_TEST(test_an_odd_number_of_identifiers_fits);
    RUN_TEST(test_the_filters_pass_what_is_wanted_and_nothing_else);
    RUN_TEST(test_the_filters_hold_eight_identifiers_and_not_nine);
    RUN_TEST(test_a_frame_goes_out_as_it_is);
    RUN_TEST(test_buffers_are_written_whole);
    RUN_TEST(test_the_lowest_identifier_leaves_first);
    RUN_TEST(test_the_last_buffer_is_kept_for_what_outranks_the_others);
    RUN_TEST(test_frames_of_one_identifier_never_overtake_each_other);
    RUN_TEST(test_frames_that_do_not_leave_are_dropped_and_counted);
    RUN_TEST(test_a_full_controller_is_waited_for_and_no_longer_than_promised);
    RUN_TEST(test_a_frame_comes_in_as_it_is);
    RUN_TEST(test_frames_come_in_their_order_and_once);
    RUN_TEST(test_the_places_of_the_fifo_are_gone_through_in_a_ring);
    RUN_TEST(test_no_interrupt_is_asked_for);
    RUN_TEST(test_bytes_beyond_the_length_are_zero);
    RUN_TEST(test_a_length_beyond_8_means_8);
    RUN_TEST(test_extended_and_remote_frames_are_told_apart);
    RUN_TEST(test_a_lost_frame_is_said_once_and_the_others_come);
    RUN_TEST(test_there_is_nothing_to_pump);
    RUN_TEST(test_a_bus_not_yet_joined_is_down);
    RUN_TEST(test_bus_off_is_down_for_the_time_asked);
    RUN_TEST(test_bus_off_is_recovered_from_and_counted);
    RUN_TEST(test_what_waited_when_the_bus_went_off_is_dropped);
    RUN_TEST(test_a_bus_that_stays_off_is_tried_again_at_a_measured_pace_and_counted_once);
    RUN_TEST(test_bus_off_with_a_dead_controller_stays_bounded);
    RUN_TEST(test_health_tells_the_controllers_own_counters);
    RUN_TEST(test_a_closed_link_leaves_the_bus_alone);
    return UNITY_END();
}
