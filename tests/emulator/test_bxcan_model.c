/* The model of bxCAN against the reference manuals: modes and reception. */
#include "bxcan_model_rig.h"

void setUp(void)
{
    join_alone(TXFP);
}

/* ---- modes */

TEST(reset_enters_sleep_and_leaves_mailboxes_undefined)
{
    bxcan_reset(&can);
    TEST_ASSERT_EQUAL_HEX32(SLAK, read_register(MSR) & (INAK | SLAK));
    TEST_ASSERT_EQUAL_HEX32(0xA5A5A5A4, read_register(0x180));
    TEST_ASSERT_EQUAL_HEX32(0xA5A5A5A5, read_register(0x184));
}

TEST(init_is_acknowledged_with_a_delay)
{
    write_register(MCR, INRQ);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(MSR) & INAK);
    pass_us(30);
    TEST_ASSERT_EQUAL_HEX32(INAK, read_register(MSR) & (INAK | SLAK));
}

TEST(init_request_is_not_acknowledged_by_a_stuck_controller)
{
    can.node.init_stuck = true;
    write_register(MCR, INRQ);
    pass_us(1000000);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(MSR) & INAK);
}

TEST(init_ends_after_eleven_recessive_bits)
{
    enter_init(&can);
    write_register(MCR, TXFP);
    pass_us(21);
    TEST_ASSERT_EQUAL_HEX32(INAK, read_register(MSR) & INAK);
    pass_us(2);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(MSR) & INAK);
}

TEST(busy_bus_blocks_sending_and_leaving_init)
{
    wire.busy = true;
    request(0, 0x81);
    pass_us(1000);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
    enter_init(&can);
    write_register(MCR, TXFP);
    pass_us(100000);
    TEST_ASSERT_EQUAL_HEX32(INAK, read_register(MSR) & INAK);
}

TEST(bxcan_refuses_a_bit_rate_other_than_the_bus)
{
    enter_init(&can);
    write_register(BTR, BIT_TIMING + 1);
    write_register(MCR, 0);
    ASSERT_REFUSED("428571 bit/s", wire_advance(&wire, wire.now_ns + 30000));
}

TEST(bit_timing_is_writable_in_init_only)
{
    ASSERT_REFUSED("BTR", node_write(&can.node, BTR, BIT_TIMING));
}

TEST(request_for_the_current_mode_changes_nothing)
{
    can.node.bus_off = true;
    write_register(MCR, TXFP | RFLM);
    pass_us(30 + RECOVERY_US);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(MSR) & (INAK | SLAK));
    TEST_ASSERT_EQUAL_HEX32(BOFF, read_register(ESR) & BOFF);
}

TEST(master_reset_clears_state_and_enters_sleep)
{
    wire.shorted = true;
    request(0, 0x81);
    pass_us(100);
    write_register(MCR, 1 << 15);
    TEST_ASSERT_EQUAL_HEX32(0x00010002, read_register(MCR));
    TEST_ASSERT_EQUAL_HEX32(SLAK, read_register(MSR) & SLAK);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(ESR));
    TEST_ASSERT_EQUAL_HEX32(TME_ALL, read_register(TSR) & TME_ALL);
}

TEST(access_to_unmodelled_features_is_refused)
{
    enter_init(&can);
    ASSERT_REFUSED("interrupts", node_write(&can.node, IER, 1));
    ASSERT_REFUSED("loop back", node_write(&can.node, BTR, 1u << 30));
    ASSERT_REFUSED("no register at 0x020", node_read(&can.node, 0x20));
    ASSERT_REFUSED("no register at 0x208", node_write(&can.node, 0x208, 0));
}

/* ---- receiving */

TEST(fifo_holds_three_frames_in_order)
{
    for (uint32_t id = 1; id <= 3; id++)
        deliver(id);
    TEST_ASSERT_EQUAL_HEX32(3 | FULL, read_register(RF0R));
    for (uint32_t id = 1; id <= 3; id++)
        TEST_ASSERT_EQUAL_HEX32(id, take_frame());
    TEST_ASSERT_EQUAL_HEX32(FULL, read_register(RF0R));   /* stays until it is cleared */
}

TEST(fifo_flags_are_cleared_by_writing_ones)
{
    for (uint32_t id = 1; id <= 4; id++)
        deliver(id);
    write_register(RF0R, 0);
    TEST_ASSERT_EQUAL_HEX32(3 | FULL | FOVR, read_register(RF0R));
    write_register(RF0R, FOVR);
    TEST_ASSERT_EQUAL_HEX32(3 | FULL, read_register(RF0R));
    write_register(RF0R, FULL);
    TEST_ASSERT_EQUAL_HEX32(3, read_register(RF0R));
}

static void assert_left_of_five(uint32_t mcr, uint32_t last)
{
    join_alone(mcr);
    for (uint32_t id = 1; id <= 5; id++)
        deliver(id);
    TEST_ASSERT_EQUAL_UINT(2, can.node.overruns);
    TEST_ASSERT_EQUAL_HEX32(1, take_frame());
    TEST_ASSERT_EQUAL_HEX32(2, take_frame());
    TEST_ASSERT_EQUAL_HEX32(last, take_frame());
}

TEST(overrun_replaces_last_frame_unless_locked)
{
    assert_left_of_five(TXFP, 5);
    assert_left_of_five(TXFP | RFLM, 3);
}

TEST(fifo_shows_a_frame_until_its_release_is_complete)
{
    can.release_slow = true;
    deliver(1);
    deliver(2);
    TEST_ASSERT_EQUAL_HEX32(1, take_frame());
    pass_us(99);
    TEST_ASSERT_EQUAL_HEX32(2 | RFOM, read_register(RF0R));
    pass_us(1);
    TEST_ASSERT_EQUAL_HEX32(1, read_register(RF0R));
}

TEST(fifo_output_refuses_writes_and_reads_when_empty)
{
    ASSERT_REFUSED("FIFO 0", node_read(&can.node, OUTPUT_0));
    ASSERT_REFUSED("read-only", node_write(&can.node, OUTPUT_0, 0));
}

TEST(fifo_output_holds_the_received_frame)
{
    (void)wire_put(&wire, &(struct frame){.id = FRAME_EXTENDED | 0x1ABCDEF0, .len = 5, .data = {1, 2, 3, 4, 5}});
    pass_us(213);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R));
    pass_us(1);
    TEST_ASSERT_EQUAL_HEX32(0x1ABCDEF0u << 3 | 4, read_register(OUTPUT_0));
    TEST_ASSERT_EQUAL_HEX32(5, read_register(OUTPUT_0 + 4) & 0xF);
    TEST_ASSERT_EQUAL_HEX32(0x04030201, read_register(OUTPUT_0 + 8));
    TEST_ASSERT_EQUAL_HEX32(5, read_register(OUTPUT_0 + 12));
}

/* ---- filters */

TEST(filter_modes_accept_matching_frames)
{
    static const struct frame frames[] = {{.id = 0xC1}, {.id = FRAME_EXTENDED | 0xC1 << 18 | 5 << 15},
                                          {.id = FRAME_REMOTE | 0xC1}, {.id = 0xC2}};
    static const struct {
        uint32_t wide, list, bank[2], passes;   /* bit n: frames[n] */
    } cases[] = {
        {1, 0, {0xC1u << 21, 0x7FFu << 21}, 7},            /* any kind */
        {1, 0, {0xC1u << 21, 0x7FFu << 21 | 6}, 1},        /* data, standard */
        {1, 1, {0xC1u << 21 | 2, 0xC2u << 21}, 12},
        {0, 1, {0xC1u << 5 | 0x700u << 21, 0x700u << 5 | 0xC2u << 21}, 9},
        {0, 0, {0xC0u << 5 | 0x7FCu << 21, 0x7FFu << 5 | 0x7FFu << 21}, 15},
        {0, 1, {0xC1u << 5 | 8 | 5, 0}, 2},
        {0, 0, {8 | 8u << 16, 8 | 8u << 16}, 2},           /* extended */
        {0, 0, {0xC1u << 5 | 0xFFF8u << 16, 0x700u << 5 | 0xFFE0u << 16}, 1},
    };

    for (unsigned i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        write_register(FMR, 1);
        write_register(FS1R, cases[i].wide);
        write_register(FM1R, cases[i].list);
        write_register(BANK_0, cases[i].bank[0]);
        write_register(BANK_0 + 4, cases[i].bank[1]);
        write_register(FMR, 0);
        for (unsigned n = 0; n < 4; n++)
            TEST_ASSERT_EQUAL_INT(cases[i].passes >> n & 1 ? 0 : -1, bxcan_fifo_for(&can, &frames[n]));
    }
}

TEST(filter_selects_the_fifo)
{
    write_register(FMR, 1);
    write_register(FFA1R, 1);
    write_register(FMR, 0);
    deliver(5);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R) & 3);
    TEST_ASSERT_EQUAL_HEX32(1, read_register(RF1R) & 3);
}

TEST(inactive_filters_and_filter_init_accept_no_frame)
{
    write_register(FA1R, 0);
    deliver(5);
    write_register(FMR, 1);
    write_register(FA1R, 1);
    deliver(5);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R) & 3);
}

TEST(active_filter_refuses_changes)
{
    ASSERT_REFUSED("F0R1", node_write(&can.node, BANK_0, 1));
    ASSERT_REFUSED("FM1R", node_write(&can.node, FM1R, 1));
    write_register(BANK_0 + 8, 1);
}
