/* The model of bxCAN against the reference manuals: errors, and what they lead to. */
#include "bxcan_model_rig.h"

void setUp(void)
{
    rejoin(TXFP);
}

TEST(a_lone_node_becomes_passive_and_never_goes_bus_off)
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

TEST(twelve_destroyed_frames_are_a_warning_sixteen_passive_and_thirty_two_bus_off)
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

TEST(bus_off_ends_by_itself_with_abom_unless_it_is_stuck)
{
    for (unsigned stuck = 0; stuck < 2; stuck++) {
        rejoin(TXFP | ABOM);
        can.node.recovery_stuck = stuck;
        request_shorted(32);
        wire.shorted = false;
        pass_us(RECOVERY_US);
        TEST_ASSERT_EQUAL_HEX32(stuck ? BOFF : 0, read_register(ESR) & BOFF);
    }
}

TEST(a_node_that_is_bus_off_neither_sends_nor_receives)
{
    request_shorted(32);
    wire.shorted = false;
    bring(5);
    TEST_ASSERT_EQUAL_UINT(0, wire.heard.count);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R) & 3);
}

TEST(a_frame_waits_for_a_node_that_is_in_init)
{
    enter_init(&can);
    bring(5);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R) & 3);
    write_register(MCR, TXFP);
    pass_us(300);
    TEST_ASSERT_EQUAL_HEX32(1, read_register(RF0R) & 3);
}

TEST(successes_make_up_for_errors)
{
    join_other();
    request_shorted(5);
    TEST_ASSERT_EQUAL_UINT(5, other.node.rec);
    wire.shorted = false;
    pass_us(400);
    TEST_ASSERT_EQUAL_UINT(5 * 8 - 1, read_register(ESR) >> 16 & 0xFF);
    TEST_ASSERT_EQUAL_UINT(4, other.node.rec);
}

TEST(a_destroyed_frame_that_was_given_up_is_over)
{
    request_shorted(0);
    pass_us(10);
    write_register(TSR, ABRQ);
    pass_us(ERROR_US);
    TEST_ASSERT_EQUAL_HEX32(RQCP | TERR, read_register(TSR) & 0xFF);
}

TEST(a_shorted_bus_makes_the_world_give_up_its_frames)
{
    wire.shorted = true;
    bring(5);
    wire.shorted = false;
    pass_us(300);
    TEST_ASSERT_EQUAL_HEX32(0, read_register(RF0R));
}

TEST(a_frame_received_ends_the_passive_state_and_clears_the_last_error)
{
    can.node.rec = 200;
    write_register(ESR, 7 << 4);
    bring(5);
    TEST_ASSERT_EQUAL_HEX32(120u << 24 | EWGF, read_register(ESR));
}

TEST(without_a_second_try_a_destroyed_frame_is_over)
{
    rejoin(TXFP | NART);
    request_shorted(4);
    TEST_ASSERT_EQUAL_HEX32(RQCP | TERR, read_register(TSR) & 0xFF);
    TEST_ASSERT_EQUAL_UINT(8, read_register(ESR) >> 16 & 0xFF);
}

TEST(the_last_error_is_told_until_it_is_written_over)
{
    wire.alone = true;
    request(0, 0x81);
    pass_us(300);
    TEST_ASSERT_EQUAL_UINT(NODE_NO_ACKNOWLEDGE, read_register(ESR) >> 4 & 7);
    write_register(ESR, 7 << 4);
    TEST_ASSERT_EQUAL_UINT(7, read_register(ESR) >> 4 & 7);
}

TEST(the_world_can_have_only_so_many_frames_waiting)
{
    enter_init(&can);
    for (unsigned i = 0; i < WIRE_QUEUE_MAX; i++)
        TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = 1}));
    TEST_ASSERT_FALSE(wire_put(&wire, &(struct frame){.id = 2}));
}
