/* What every CAN controller's driver has to do, with the link on top of it: opening and receiving. Built once with each rig. */
#include "can_link_cases.h"

#include "tests/test.h"
#include "hal/port/cortex_m/can_controller.h"
#include "hal/port/cortex_m/uart.h"

BEFORE_EACH(can_link)
{
    rig_reset();
    TEST_ASSERT_EQUAL(0, open_link());
    rig_pass_us(100);
}

/* ---- opening */

TEST(bit_rate_is_500_kbit_s_at_every_clock)
{
    for (const uint32_t *hz = RIG_CLOCKS_HZ; *hz != 0; hz++) {
        struct rig_bit bit;

        rig_reset();
        rig_set_clock(*hz);
        TEST_ASSERT_EQUAL(0, open_link());
        bit = rig_bit();
        TEST_ASSERT_EQUAL_UINT32(*hz, 500000 * bit.prescaler * (bit.before + bit.after));
        TEST_ASSERT_UINT32_WITHIN(25, 875, 1000 * bit.before / (bit.before + bit.after));   /* sample point, in 1/1000 */
        TEST_ASSERT_EQUAL_UINT32(2, bit.jump);                                              /* and no test mode beside it */
    }
}

TEST(link_name_may_contain_a_bit_rate)
{
    static const struct {
        const char *name;
        uint32_t bitrate;
    } rates[] = {{"125000", 125000}, {"250000", 250000}, {"500000", 500000}, {"1000000", 1000000}};

    for (unsigned i = 0; i < sizeof rates / sizeof rates[0]; i++)
        for (const uint32_t *hz = RIG_CLOCKS_HZ; *hz != 0; hz++) {
            struct rig_bit bit;

            rig_reset();
            rig_set_clock(*hz);
            TEST_ASSERT_EQUAL(0, link_open(&link_here, rates[i].name, WANTED, 2));
            bit = rig_bit();
            TEST_ASSERT_EQUAL_UINT32(*hz, rates[i].bitrate * bit.prescaler * (bit.before + bit.after));
        }
}

TEST(open_fails_without_a_divisor_for_500_kbit_s)
{
    rig_reset();
    rig_set_clock(36000000 + 500);
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_link());
    rig_set_clock(3000000);
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_link());
    rig_set_clock(19 * 500000);   /* more quanta than every controller can do */
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_link());
}

TEST(link_opens_with_a_clock_of_8_quanta_per_bit)
{
    rig_reset();
    rig_set_clock(8 * 500000);
    TEST_ASSERT_EQUAL(0, open_link());
}

TEST(open_of_a_dead_controller_fails_within_5_ms)
{
    rig_reset();
    rig_stop_answering();
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_link());
    TEST_ASSERT_LESS_THAN_UINT32(5, rig_ms());
}

TEST(filter_passes_exactly_the_wanted_identifiers)
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

TEST(filter_passes_an_identifier_range_into_its_own_fifo)
{
    open_family();
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == 0x0C1 ? 0 : id >= 0x680 && id <= 0x69F ? 1 : -1, rig_fifo_for(id));
}

TEST(identifier_range_may_come_first_in_the_list)
{
    static const uint16_t ids[] = {LINK_FAMILY | 0x680, 0x0C1};

    rig_reset();
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, 2));
    rig_pass_us(100);
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == 0x0C1 ? 0 : id >= 0x680 && id <= 0x69F ? 1 : -1, rig_fifo_for(id));
}

TEST(filter_holds_at_most_eight_identifiers)
{
    static const uint16_t ids[] = {1, 2, 3, 4, 5, 6, 7, 0x7FF, 9};

    rig_reset();
    TEST_ASSERT_EQUAL(LINK_E_OPEN, link_open(&link_here, "", ids, 9));
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, LINK_IDS_MAX));
    rig_pass_us(100);
    for (unsigned i = 0; i < 9; i++)
        TEST_ASSERT_EQUAL(i < 8 ? 0 : -1, rig_fifo_for(ids[i]));
}

/* ---- receiving */

TEST(received_frame_is_unchanged)
{
    struct frame frame = numbered(0x0C1, 9);

    rig_deliver(&frame);
    assert_receives(&frame);
}

TEST(frames_are_received_once_and_in_order)
{
    for (uint8_t n = 0; n < 3; n++)
        rig_deliver(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    for (uint8_t n = 0; n < 3; n++)
        assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    wait_ms(1);
}

TEST(bytes_beyond_the_length_are_zero)
{
    rig_deliver(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2}});
}

TEST(length_over_8_is_received_as_8)
{
    struct frame frame = numbered(0x0C1, 0);

    frame.len = 15;
    rig_deliver(&frame);
    frame.len = 8;
    assert_receives(&frame);
}

TEST(extended_and_remote_frames_are_flagged)
{
    rig_open_filters();
    rig_deliver(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    rig_deliver(&(struct frame){.id = FRAME_EXTENDED | 0x12345679});
    rig_deliver(&(struct frame){.id = FRAME_REMOTE | 0x0C2});
    assert_receives(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    assert_receives(&(struct frame){.id = FRAME_EXTENDED | 0x12345679});
    assert_receives(&(struct frame){.id = FRAME_REMOTE | 0x0C2});
}

TEST(receive_returns_silence_after_the_wait)
{
    uint32_t start = rig_ms();

    wait_ms(WAIT_MS);
    TEST_ASSERT_UINT32_WITHIN(1, WAIT_MS, rig_ms() - start);
}

/* Which of the frames are lost depends on the controller. */
TEST(overrun_is_reported_once_and_other_frames_arrive)
{
    struct frame frame;

    for (uint8_t n = 0; n < 5; n++)
        rig_deliver(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, link_receive(link_here, &frame, WAIT_MS));
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {0}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {1}});
    TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, 0));
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 0));
}

TEST(overrun_of_one_fifo_leaves_the_other_unchanged)
{
    struct frame frame;

    open_family();
    for (uint8_t n = 0; n < 5; n++)
        rig_deliver(&(struct frame){.id = 0x681u + n, .len = 1});
    rig_deliver(&(struct frame){.id = 0x0C1, .len = 1, .data = {7}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {7}});
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, link_receive(link_here, &frame, 0));
    assert_receives(&(struct frame){.id = 0x681, .len = 1});
}

TEST(line_pump_does_nothing_on_a_can_link)
{
    line_pump();
    TEST_ASSERT_EQUAL_UINT(0, rig_sent_count());
}

/* What every CAN controller's driver has to do, without the link on top of it. Built once with each rig. */

BEFORE_EACH(can_controller)
{
    uint32_t clocks = RIG_CLOCKS_HZ[0] / OCTET_CAN_BITRATE, quanta = clocks % 14 == 0 ? 14 : 16;

    rig_reset();
    TEST_ASSERT_TRUE(can_stop());
    can_set_up(clocks / quanta, quanta, WANTED, 2);
    rig_set_clock(RIG_CLOCKS_HZ[0]);
    can_start();
    rig_pass_us(100);
}

static bool put(uint32_t id, uint8_t number)
{
    bool taken = can_put(&(struct frame){.id = id, .len = 1, .data = {number}});

    rig_pass_us(0);
    return taken;
}

static void abort_buffers(uint32_t buffers)
{
    can_abort(buffers);
    rig_pass_us(1);
}

TEST(no_frame_waits_on_an_idle_bus)
{
    TEST_ASSERT_EQUAL_HEX32(0, can_waiting());
}

TEST(can_waiting_reports_buffers_and_identifiers)
{
    static const uint32_t expected[] = {0x100, 0x7FF, 0x001};

    rig_block(true);
    for (unsigned n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(expected[n], 0));
    TEST_ASSERT_EQUAL_HEX32(7, can_waiting());
    for (unsigned n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_EQUAL_HEX32(expected[n], can_waiting_id(n));
    abort_buffers(2);
    TEST_ASSERT_EQUAL_HEX32(5, can_waiting());
}

TEST(full_controller_refuses_a_frame)
{
    rig_block(true);
    for (unsigned n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(0x100 + n, 0));
    TEST_ASSERT_FALSE(put(0x200, 0));
}

/* Equal identifiers leave by number of buffer. */
TEST(frame_takes_no_buffer_that_overtakes_an_equal_identifier)
{
    for (uint32_t free = 1; free < 7; free++) {
        bool last_is_free = free >> 2 & 1u;

        prepare_can_controller();
        rig_block(true);
        for (uint8_t n = 0; n < CAN_BUFFERS; n++)
            TEST_ASSERT_TRUE(put(0x100, n));
        abort_buffers(free);
        TEST_ASSERT_EQUAL_HEX32(7u & ~free, can_waiting());
        if (!last_is_free)
            TEST_ASSERT_FALSE(put(0x100, 9));
    }
}

TEST(equal_identifier_in_the_last_buffer_refuses_a_frame)
{
    rig_block(true);
    for (uint8_t n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(0x102u - n, n));
    abort_buffers(3);
    TEST_ASSERT_FALSE(put(0x100, 9));
}

TEST(equal_identifier_in_an_earlier_buffer_is_no_obstacle)
{
    rig_block(true);
    for (uint8_t n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(0x100, n));
    abort_buffers(1u << 2);
    TEST_ASSERT_TRUE(put(0x100, 7));
    TEST_ASSERT_EQUAL_HEX32(7, can_waiting());
    rig_block(false);
    rig_pass_us(3000);
    TEST_ASSERT_EQUAL_UINT(3, rig_sent_count());
    TEST_ASSERT_EQUAL_UINT8(7, rig_sent(2)->data[0]);
}

TEST(frames_of_other_identifiers_take_any_buffer)
{
    static const uint32_t others[] = {0x0FF, 0x101};

    for (unsigned i = 0; i < 2; i++) {
        prepare_can_controller();
        rig_block(true);
        for (uint8_t n = 0; n < CAN_BUFFERS; n++)
            TEST_ASSERT_TRUE(put(0x100, n));
        abort_buffers(3);
        TEST_ASSERT_TRUE(put(others[i], 0));
        TEST_ASSERT_TRUE(put(others[i], 1));
    }
}

/* A buffer keeps the identifier of what has left it. */
TEST(sent_frames_are_no_obstacle)
{
    for (uint8_t n = 0; n < 2; n++)
        TEST_ASSERT_TRUE(put(0x100, n));
    TEST_ASSERT_TRUE(put(0x100, 2));
    rig_pass_us(3000);
    for (uint8_t n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(0x100, n));
}

TEST(can_stop_times_out_if_the_controller_stays_on_the_bus)
{
    uint32_t start;

    rig_stop_answering();
    for (start = rig_ms(); rig_ms() == start;)
        rig_pass_us(10);
    start = rig_ms();
    TEST_ASSERT_FALSE(can_stop());
    TEST_ASSERT_EQUAL_UINT32(start + CAN_STOP_MS + 1, rig_ms());
}
