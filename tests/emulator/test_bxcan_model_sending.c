/* The model of bxCAN against the reference manuals: what is sent, and who goes first. */
#include "bxcan_model_rig.h"

void setUp(void)
{
    rejoin(TXFP);
}

/* ---- sending */

TEST(a_frame_takes_its_bits_to_leave)
{
    const uint8_t data[] = {1, 2, 3, 4, 0, 0, 0, 0};

    request(0, 0x81);
    pass_us(221);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
    pass_us(1);
    ASSERT_HEARD(0x81);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(data, wire.heard.frames[0].data, 8);
}

TEST(what_became_of_a_frame_is_cleared_by_writing_ones)
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
    rejoin(mcr);
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

TEST(the_lowest_identifier_leaves_first_without_txfp)
{
    request_three(0);
    pass_us(1000);
    ASSERT_HEARD(0x100, 0x200, 0x300);
}

TEST(equal_identifiers_leave_by_mailbox_number_without_txfp)
{
    rejoin(0);
    for (uint32_t n = 3; n-- > 0;)
        request(n, 0x100);
    pass_us(1000);
    for (uint8_t n = 0; n < 3; n++)
        TEST_ASSERT_EQUAL_UINT8(n, wire.heard.frames[n].data[4]);
}

TEST(the_status_names_a_free_mailbox_or_the_one_to_leave_last)
{
    request(0, 0x81);
    TEST_ASSERT_EQUAL_HEX32(6u << 26 | 1u << 24, read_register(TSR));
    request(1, 0x82);
    request(2, 0x80);
    TEST_ASSERT_EQUAL_HEX32(4u << 29 | 2u << 24, read_register(TSR));
    pass_us(1000);
    TEST_ASSERT_EQUAL_HEX32(TME_ALL, read_register(TSR) & 0xFF000000u);
}

TEST(a_pending_mailbox_must_not_be_written)
{
    request(0, 0x81);
    ASSERT_REFUSED("mailbox 0", node_write(&can.node, 0x184, 1));
}

TEST(a_request_is_given_up_unless_it_is_on_the_wire)
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

TEST(a_stuck_mailbox_neither_sends_nor_gives_up)
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

TEST(the_lower_identifier_wins_the_bus)
{
    (void)wire_put(&wire, &(struct frame){.id = 0x100});
    request(0, 0x81);
    request(1, 0x200);
    pass_us(230);   /* 0x81 has left, and 0x100 is on the wire */
    ASSERT_HEARD(0x81);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R) & 3);
    pass_us(100);
    TEST_ASSERT_EQUAL_HEX32(0x100, take());
    pass_us(300);
    ASSERT_HEARD(0x81, 0x200);
}

TEST(a_data_frame_goes_before_a_remote_one_and_that_before_an_extended_one)
{
    static const uint32_t ids[] = {FRAME_EXTENDED | 0x100 << 18, FRAME_REMOTE | 0x100, 0x101};

    for (unsigned i = 0; i < 3; i++) {
        rejoin(TXFP);
        (void)wire_put(&wire, &(struct frame){.id = ids[i]});
        request(0, 0x100);
        pass_us(222);
        ASSERT_HEARD(0x100);
    }
    rejoin(TXFP);
    (void)wire_put(&wire, &(struct frame){.id = FRAME_REMOTE | 0x100});
    write_register(0x184, 0);
    write_register(0x180, 0x100u << 21 | 4 | 1);   /* extended */
    pass_us(94);
    TEST_ASSERT_EQUAL_HEX32(1, read_register(RF0R));
}

TEST(a_frame_that_lost_arbitration_can_be_given_up)
{
    (void)wire_put(&wire, &(struct frame){.id = 0x100, .len = 8});
    request(0, 0x200);
    pass_us(50);
    write_register(TSR, ABRQ);
    pass_us(1000);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
}

TEST(without_a_second_try_lost_arbitration_is_the_end)
{
    rejoin(TXFP | NART);
    (void)wire_put(&wire, &(struct frame){.id = 0x100});
    request(0, 0x200);
    pass_us(1000);
    TEST_ASSERT_EQUAL_HEX32(RQCP | ALST, read_register(TSR) & 0xFF);
}

TEST(the_same_frame_goes_to_the_world_first)
{
    (void)wire_put(&wire, &(struct frame){.id = 0x100});
    request(0, 0x100);
    pass_us(100);
    TEST_ASSERT_EQUAL_HEX32(0x100, take());
}

TEST(a_frame_that_lost_to_another_controller_can_be_given_up_at_once)
{
    join_other();
    request(0, 0x200);
    request_from(&other, 0, 0x100);
    pass_us(10);
    write_register(TSR, ABRQ);
    TEST_ASSERT_EQUAL_HEX32(RQCP, read_register(TSR) & 0xFF);
}

TEST(controllers_acknowledge_each_other_and_the_lower_identifier_goes_first)
{
    join_other();
    wire.alone = true;
    request(0, 0x200);
    request_from(&other, 0, 0x100);
    pass_us(1000);
    TEST_ASSERT_EQUAL_HEX32(0x100, take());
    TEST_ASSERT_EQUAL_HEX32(0x200u << 21, (uint32_t)node_read(&other.node, OUTPUT_0));
    TEST_ASSERT_EQUAL_HEX32(0, read_register(ESR));
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
}
