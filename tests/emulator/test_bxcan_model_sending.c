/* The model of bxCAN against the reference manuals: transmission and arbitration. */
#include "bxcan_model_rig.h"

void setUp(void)
{
    join_alone(TXFP);
}

/* ---- sending */

TEST(frame_leaves_after_its_bit_times)
{
    const uint8_t data[] = {1, 2, 3, 4, 0, 0, 0, 0};

    request(0, 0x81);
    pass_us(221);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
    pass_us(1);
    ASSERT_HEARD(0x81);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(data, wire.heard.frames[0].data, 8);
}

TEST(transmit_status_is_cleared_by_writing_ones)
{
    request(1, 0x81);
    pass_us(300);
    write_register(TSR, 0);
    TEST_ASSERT_EQUAL_HEX32(RQCP | TXOK, read_register(TSR) >> 8 & 0xFF);
    write_register(TSR, RQCP << 8);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(TSR) >> 8 & 0xFF);
    request(1, 0x81);
    pass_us(300);
    request(1, 0x81);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(TSR) >> 8 & 0xFF);   /* a new request clears them too */
}

static void request_three(uint32_t mcr)
{
    join_alone(mcr);
    request(2, 0x300);
    request(0, 0x200);
    request(1, 0x100);
}

TEST(mailboxes_leave_in_the_order_of_request_with_txfp)
{
    request_three(TXFP);
    pass_us(1000);
    ASSERT_HEARD(0x300, 0x200, 0x100);
}

TEST(lowest_identifier_leaves_first_without_txfp)
{
    request_three(0);
    pass_us(1000);
    ASSERT_HEARD(0x100, 0x200, 0x300);
}

TEST(equal_identifiers_leave_by_mailbox_number_without_txfp)
{
    join_alone(0);
    for (uint32_t n = 3; n-- > 0;)
        request(n, 0x100);
    pass_us(1000);
    for (uint8_t n = 0; n < 3; n++)
        TEST_ASSERT_EQUAL_UINT8(n, wire.heard.frames[n].data[4]);
}

TEST(tsr_code_is_free_or_lowest_priority_mailbox)
{
    request(0, 0x81);
    TEST_ASSERT_EQUAL_HEX32(6u << 26 | 1u << 24, read_register(TSR));
    request(1, 0x82);
    request(2, 0x80);
    TEST_ASSERT_EQUAL_HEX32(4u << 29 | 2u << 24, read_register(TSR));
    pass_us(1000);
    TEST_ASSERT_EQUAL_HEX32(TME_ALL, read_register(TSR) & 0xFF000000u);
}

TEST(pending_mailbox_refuses_writes)
{
    request(0, 0x81);
    ASSERT_REFUSED("mailbox 0", node_write(&can.node, 0x184, 1));
}

TEST(abort_request_spares_the_frame_on_the_wire)
{
    request(0, 0x81);
    request(1, 0x82);
    pass_us(10);
    write_register(TSR, ABRQ | ABRQ << 8);
    TEST_ASSERT_EQUAL_HEX32(RQCP << 8, read_register(TSR) & 0xFFFF);
    pass_us(1000);
    ASSERT_HEARD(0x81);
    TEST_ASSERT_EQUAL_HEX32((RQCP | TXOK) | RQCP << 8, read_register(TSR) & 0xFFFF);
}

TEST(stuck_mailbox_neither_sends_nor_aborts)
{
    can.node.stuck_mailboxes = 1;
    request(0, 0x81);
    request(1, 0x82);
    write_register(TSR, ABRQ);
    pass_us(1000);
    ASSERT_HEARD(0x82);
    TEST_ASSERT_EQUAL_HEX32(6u << 26, read_register(TSR) & TME_ALL);
}

/* ---- arbitration */

TEST(lower_identifier_wins_arbitration)
{
    (void)wire_put(&wire, &(struct frame){.id = 0x100});
    request(0, 0x81);
    request(1, 0x200);
    pass_us(230);   /* 0x81 has left, and 0x100 is on the wire */
    ASSERT_HEARD(0x81);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R) & 3);
    pass_us(100);
    TEST_ASSERT_EQUAL_HEX32(0x100, take_frame());
    pass_us(300);
    ASSERT_HEARD(0x81, 0x200);
}

TEST(arbitration_prefers_data_to_remote_to_extended_frames)
{
    static const uint32_t ids[] = {FRAME_EXTENDED | 0x100 << 18, FRAME_REMOTE | 0x100, 0x101};

    for (unsigned i = 0; i < 3; i++) {
        join_alone(TXFP);
        (void)wire_put(&wire, &(struct frame){.id = ids[i]});
        request(0, 0x100);
        pass_us(222);
        ASSERT_HEARD(0x100);
    }
    join_alone(TXFP);
    (void)wire_put(&wire, &(struct frame){.id = FRAME_REMOTE | 0x100});
    write_register(0x184, 0);
    write_register(0x180, 0x100u << 21 | 4 | 1);   /* extended */
    pass_us(94);
    TEST_ASSERT_EQUAL_HEX32(1, read_register(RF0R));
}

TEST(abort_after_lost_arbitration_sends_no_frame)
{
    (void)wire_put(&wire, &(struct frame){.id = 0x100, .len = 8});
    request(0, 0x200);
    pass_us(50);
    write_register(TSR, ABRQ);
    pass_us(1000);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
}

TEST(frame_that_loses_arbitration_without_retransmission_fails)
{
    join_alone(TXFP | NART);
    (void)wire_put(&wire, &(struct frame){.id = 0x100});
    request(0, 0x200);
    pass_us(1000);
    TEST_ASSERT_EQUAL_HEX32(RQCP | ALST, read_register(TSR) & 0xFF);
}

TEST(frame_of_the_world_wins_against_an_equal_identifier)
{
    (void)wire_put(&wire, &(struct frame){.id = 0x100});
    request(0, 0x100);
    pass_us(100);
    TEST_ASSERT_EQUAL_HEX32(0x100, take_frame());
}

TEST(abort_after_loss_to_a_controller_is_immediate)
{
    join_other();
    request(0, 0x200);
    request_from(&other, 0, 0x100);
    pass_us(10);
    write_register(TSR, ABRQ);
    TEST_ASSERT_EQUAL_HEX32(RQCP, read_register(TSR) & 0xFF);
}

TEST(controllers_acknowledge_and_arbitrate_with_each_other)
{
    join_other();
    wire.alone = true;
    request(0, 0x200);
    request_from(&other, 0, 0x100);
    pass_us(1000);
    TEST_ASSERT_EQUAL_HEX32(0x100, take_frame());
    TEST_ASSERT_EQUAL_HEX32(0x200u << 21, (uint32_t)node_read(&other.node, OUTPUT_0));
    TEST_ASSERT_EQUAL_HEX32(0, read_register(ESR));
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
}

/* The model of bxCAN against the reference manuals: error states and counters. */

TEST(lone_node_becomes_error_passive_but_not_bus_off)
{
    wire.alone = true;
    request(0, 0x81);
    pass_us(100000);
    TEST_ASSERT_EQUAL_HEX32(128u << 16 | 3u << 4 | EWGF | EPVF, read_register(ESR));
    TEST_ASSERT_EQUAL_HEX32(6u << 26, read_register(TSR) & TME_ALL);
}

static void request_shorted(uint32_t errors)
{
    wire.shorted = true;
    request(0, 0x81);
    pass_us(errors * ERROR_US);
}

TEST(errors_lead_to_warning_passive_and_bus_off)
{
    static const uint32_t expected[] = {0, EWGF, EWGF, EWGF | EPVF, EWGF | EPVF, EWGF | EPVF | BOFF};
    static const uint32_t errors[] = {11, 1, 3, 1, 15, 1};

    request_shorted(0);
    for (unsigned i = 0; i < 6; i++) {
        pass_us(errors[i] * ERROR_US);
        TEST_ASSERT_EQUAL_HEX32(expected[i], read_register(ESR) & (EWGF | EPVF | BOFF));
    }
}

TEST(bus_off_lasts_until_init_and_128_times_11_bits)
{
    request_shorted(32);
    wire.shorted = false;
    pass_us(1000000);
    TEST_ASSERT_EQUAL_HEX32(BOFF, read_register(ESR) & BOFF);
    enter_init(&can);
    write_register(MCR, TXFP);
    pass_us(22 + RECOVERY_US - 1);
    TEST_ASSERT_EQUAL_HEX32(BOFF, read_register(ESR) & BOFF);
    pass_us(1);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(ESR));
    pass_us(300);
    ASSERT_HEARD(0x81);
}

TEST(abom_ends_bus_off_unless_recovery_is_stuck)
{
    for (unsigned stuck = 0; stuck < 2; stuck++) {
        join_alone(TXFP | ABOM);
        can.node.recovery_stuck = stuck;
        request_shorted(32);
        wire.shorted = false;
        pass_us(RECOVERY_US);
        TEST_ASSERT_EQUAL_HEX32(stuck ? BOFF : 0, read_register(ESR) & BOFF);
    }
}

TEST(bus_off_node_neither_sends_nor_receives)
{
    request_shorted(32);
    wire.shorted = false;
    deliver(5);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R) & 3);
}

TEST(frame_waits_for_a_receiver_in_init)
{
    enter_init(&can);
    deliver(5);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R) & 3);
    write_register(MCR, TXFP);
    pass_us(300);
    TEST_ASSERT_EQUAL_HEX32(1, read_register(RF0R) & 3);
}

TEST(successful_frames_decrement_error_counters)
{
    join_other();
    request_shorted(5);
    TEST_ASSERT_EQUAL_UINT(5, other.node.rec);
    wire.shorted = false;
    pass_us(400);
    TEST_ASSERT_EQUAL_UINT(5 * 8 - 1, read_register(ESR) >> 16 & 0xFF);
    TEST_ASSERT_EQUAL_UINT(4, other.node.rec);
}

TEST(aborted_frame_is_not_repeated_after_an_error)
{
    request_shorted(0);
    pass_us(10);
    write_register(TSR, ABRQ);
    pass_us(ERROR_US);
    TEST_ASSERT_EQUAL_HEX32(RQCP | TERR, read_register(TSR) & 0xFF);
}

TEST(shorted_bus_drops_frames_of_the_world)
{
    wire.shorted = true;
    deliver(5);
    wire.shorted = false;
    pass_us(300);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R));
}

TEST(received_frame_ends_error_passive_and_clears_lec)
{
    can.node.rec = 200;
    write_register(ESR, 7 << 4);
    deliver(5);
    TEST_ASSERT_EQUAL_HEX32(120u << 24 | EWGF, read_register(ESR));
}

TEST(nart_sends_a_destroyed_frame_once)
{
    join_alone(TXFP | NART);
    request_shorted(4);
    TEST_ASSERT_EQUAL_HEX32(RQCP | TERR, read_register(TSR) & 0xFF);
    TEST_ASSERT_EQUAL_UINT(8, read_register(ESR) >> 16 & 0xFF);
}

TEST(last_error_code_stays_until_overwritten)
{
    wire.alone = true;
    request(0, 0x81);
    pass_us(300);
    TEST_ASSERT_EQUAL_UINT(NODE_NO_ACKNOWLEDGE, read_register(ESR) >> 4 & 7);
    write_register(ESR, 7 << 4);
    TEST_ASSERT_EQUAL_UINT(7, read_register(ESR) >> 4 & 7);
}

TEST(wire_put_fails_when_its_queue_is_full)
{
    enter_init(&can);
    for (unsigned i = 0; i < WIRE_QUEUE_MAX; i++)
        TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = 1}));
    TEST_ASSERT_FALSE(wire_put(&wire, &(struct frame){.id = 2}));
}
