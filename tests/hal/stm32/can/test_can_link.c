/* What every CAN controller's driver has to do, with the link on top of it: opening and receiving. Built once with each rig. */
#include "can_link_cases.h"
#include "hal/port/cortex_m/uart.h"

void setUp(void)
{
    rig_reset();
    TEST_ASSERT_EQUAL(0, open_it());
    rig_pass_us(100);
}

/* ---- opening */

TEST(the_bit_rate_is_500_kbit_s_from_every_clock_it_may_run_at)
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

TEST(its_name_may_tell_another_bit_rate)
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

TEST(a_clock_without_a_divisor_for_500_kbit_s_does_not_open)
{
    rig_reset();
    rig_set_clock(36000000 + 500);
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
    rig_set_clock(3000000);
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
    rig_set_clock(19 * 500000);   /* more quanta than every controller can do */
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
}

TEST(a_clock_of_8_quanta_will_do)
{
    rig_reset();
    rig_set_clock(8 * 500000);
    TEST_ASSERT_EQUAL(0, open_it());
}

TEST(a_controller_that_does_not_answer_is_given_up_soon)
{
    rig_reset();
    rig_fall_silent();
    TEST_ASSERT_EQUAL(LINK_E_OPEN, open_it());
    TEST_ASSERT_LESS_THAN_UINT32(5, rig_ms());
}

TEST(the_filters_pass_what_is_wanted_and_nothing_else)
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

TEST(a_family_is_let_through_whole_and_waits_apart)
{
    open_family();
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == 0x0C1 ? 0 : id >= 0x680 && id <= 0x69F ? 1 : -1, rig_fifo_for(id));
}

TEST(it_does_not_matter_which_of_them_is_a_family)
{
    static const uint16_t ids[] = {LINK_FAMILY | 0x680, 0x0C1};

    rig_reset();
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, 2));
    rig_pass_us(100);
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == 0x0C1 ? 0 : id >= 0x680 && id <= 0x69F ? 1 : -1, rig_fifo_for(id));
}

TEST(the_filters_hold_eight_identifiers_and_not_nine)
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

TEST(a_frame_comes_in_as_it_is)
{
    struct frame frame = numbered(0x0C1, 9);

    rig_bring(&frame);
    assert_receives(&frame);
}

TEST(frames_come_in_their_order_and_once)
{
    for (uint8_t n = 0; n < 3; n++)
        rig_bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    for (uint8_t n = 0; n < 3; n++)
        assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    wait_ms(1);
}

TEST(bytes_beyond_the_length_are_zero)
{
    rig_bring(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2, 3, 4, 5, 6, 7, 8}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 2, .data = {1, 2}});
}

TEST(a_length_beyond_8_means_8)
{
    struct frame frame = numbered(0x0C1, 0);

    frame.len = 15;
    rig_bring(&frame);
    frame.len = 8;
    assert_receives(&frame);
}

TEST(extended_and_remote_frames_are_told_apart)
{
    rig_open_filters();
    rig_bring(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    rig_bring(&(struct frame){.id = FRAME_EXTENDED | 0x12345679});
    rig_bring(&(struct frame){.id = FRAME_REMOTE | 0x0C2});
    assert_receives(&(struct frame){.id = FRAME_EXTENDED | 0x12345678});
    assert_receives(&(struct frame){.id = FRAME_EXTENDED | 0x12345679});
    assert_receives(&(struct frame){.id = FRAME_REMOTE | 0x0C2});
}

TEST(silence_is_waited_out)
{
    uint32_t start = rig_ms();

    wait_ms(WAIT_MS);
    TEST_ASSERT_UINT32_WITHIN(1, WAIT_MS, rig_ms() - start);
}

/* Which of them are lost is the controller's business. */
TEST(lost_frames_are_said_once_and_the_others_come)
{
    struct frame frame;

    for (uint8_t n = 0; n < 5; n++)
        rig_bring(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, link_receive(link_here, &frame, WAIT_MS));
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {0}});
    assert_receives(&(struct frame){.id = 0x0C1, .len = 1, .data = {1}});
    TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, 0));
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 0));
}

TEST(a_family_that_overruns_pushes_out_nothing_else)
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

TEST(there_is_nothing_to_pump)
{
    line_pump();
    TEST_ASSERT_EQUAL_UINT(0, rig_sent_count());
}
