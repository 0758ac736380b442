/* What every CAN controller's driver has to do, without the link on top of it. Built once with each rig. */
#include "tests/test.h"
#include "can_rig.h"
#include "hal/port/cortex_m/can_controller.h"
#include "hal/stm32/can_timing.h"

static const uint16_t WANTED[] = {0x0C1, 0x041};

void setUp(void)
{
    uint32_t quanta = can_quanta(RIG_CLOCKS_HZ[0], CAN_BITRATE);

    rig_reset();
    TEST_ASSERT_TRUE(can_stop());
    can_set_up(RIG_CLOCKS_HZ[0] / (CAN_BITRATE * quanta), quanta, WANTED, 2);
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

static void give_up(uint32_t buffers)
{
    can_abort(buffers);
    rig_pass_us(1);
}

TEST(nothing_waits_on_an_idle_bus)
{
    TEST_ASSERT_EQUAL_HEX32(0, can_waiting());
}

TEST(what_waits_is_told_with_its_identifiers)
{
    static const uint32_t expected[] = {0x100, 0x7FF, 0x001};

    rig_block(true);
    for (unsigned n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(expected[n], 0));
    TEST_ASSERT_EQUAL_HEX32(7, can_waiting());
    for (unsigned n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_EQUAL_HEX32(expected[n], can_waiting_id(n));
    give_up(2);
    TEST_ASSERT_EQUAL_HEX32(5, can_waiting());
}

TEST(a_full_controller_takes_no_more)
{
    rig_block(true);
    for (unsigned n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(0x100 + n, 0));
    TEST_ASSERT_FALSE(put(0x200, 0));
}

/* Equal identifiers leave by number of buffer. */
TEST(a_frame_takes_no_buffer_from_which_it_would_overtake_an_equal_one)
{
    for (uint32_t free = 1; free < 7; free++) {
        bool last_is_free = free >> 2 & 1u;

        setUp();
        rig_block(true);
        for (uint8_t n = 0; n < CAN_BUFFERS; n++)
            TEST_ASSERT_TRUE(put(0x100, n));
        give_up(free);
        TEST_ASSERT_EQUAL_HEX32(7u & ~free, can_waiting());
        if (!last_is_free)
            TEST_ASSERT_FALSE(put(0x100, 9));
    }
}

TEST(an_equal_frame_in_the_last_buffer_keeps_the_free_ones_before_it_free)
{
    rig_block(true);
    for (uint8_t n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(0x102u - n, n));
    give_up(3);
    TEST_ASSERT_FALSE(put(0x100, 9));
}

TEST(an_equal_frame_that_waits_in_an_earlier_buffer_is_no_obstacle)
{
    rig_block(true);
    for (uint8_t n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(0x100, n));
    give_up(1u << 2);
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
        setUp();
        rig_block(true);
        for (uint8_t n = 0; n < CAN_BUFFERS; n++)
            TEST_ASSERT_TRUE(put(0x100, n));
        give_up(3);
        TEST_ASSERT_TRUE(put(others[i], 0));
        TEST_ASSERT_TRUE(put(others[i], 1));
    }
}

/* A buffer keeps the identifier of what has left it. */
TEST(frames_that_have_left_are_no_obstacle)
{
    for (uint8_t n = 0; n < 2; n++)
        TEST_ASSERT_TRUE(put(0x100, n));
    TEST_ASSERT_TRUE(put(0x100, 2));
    rig_pass_us(3000);
    for (uint8_t n = 0; n < CAN_BUFFERS; n++)
        TEST_ASSERT_TRUE(put(0x100, n));
}

TEST(a_controller_that_does_not_leave_the_bus_is_waited_for_as_long_as_a_frame_may_take)
{
    uint32_t start;

    rig_fall_silent();
    for (start = rig_ms(); rig_ms() == start;)
        rig_pass_us(10);
    start = rig_ms();
    TEST_ASSERT_FALSE(can_stop());
    TEST_ASSERT_EQUAL_UINT32(start + CAN_STOP_MS + 1, rig_ms());
}
