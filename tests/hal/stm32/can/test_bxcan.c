#include "tests/test.h"
#include "bxcan_rig.h"
#include "hal/link/link.h"

static const uint16_t WANTED[] = {0x0C1, 0x041};
static struct link *link_here;

void setUp(void)
{
    rig_reset();
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", WANTED, 2));
    rig_pass_us(100);
}

TEST(bxcan_leaves_sleep_with_priority_by_identifier)
{
    TEST_ASSERT_EQUAL_HEX32(0, CAN1.mcr);
}

/* Banks of zeros let everything in. */
TEST(link_open_replaces_the_filters_that_a_boot_loader_left)
{
    static const uint32_t modes[] = {0, 0x3FFF};
    static const uint16_t ids[] = {0x0C1, LINK_FAMILY | 0x680};

    for (unsigned i = 0; i < 4; i++) {
        rig_reset();
        rig_leave_filters(modes[i % 2], modes[i / 2], 0);
        TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, 2));
        rig_pass_us(100);
        for (uint32_t id = 0; id <= 0x7FF; id++)
            TEST_ASSERT_EQUAL(id == 0x0C1 ? 0 : id >= 0x680 && id <= 0x69F ? 1 : -1,
                              bxcan_fifo_for(&can, &(struct frame){.id = id}));
    }
}

TEST(frames_before_bus_off_are_still_received)
{
    struct frame frame;

    for (uint8_t n = 0; n < 5; n++)
        TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = 0x0C1, .len = 1, .data = {n}}));
    rig_pass_us(1500);
    can.node.bus_off = can.node.recovery_stuck = true;
    rig_pass_us(0);
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, link_receive(link_here, &frame, 0));
    TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, 0));
    TEST_ASSERT_EQUAL_UINT8(0, frame.data[0]);
}

TEST(mailboxes_are_written_whole)
{
    struct frame frame = {.id = 0x7A5, .len = 8};

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
    TEST_ASSERT_EQUAL_HEX32(0x7A5u << 21 | 1u, CAN1.sent[0].id);
    TEST_ASSERT_EQUAL_HEX32(8, CAN1.sent[0].length);
}

TEST(frame_being_released_is_received_once)
{
    struct frame frame;

    can.release_slow = true;
    for (uint8_t n = 1; n <= 2; n++)
        TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = 0x0C1, .len = 1, .data = {n}}));
    rig_pass_us(600);
    for (uint8_t n = 1; n <= 2; n++) {
        TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, 1));
        TEST_ASSERT_EQUAL_UINT8(n, frame.data[0]);
    }
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 1));
}

TEST(interrupts_stay_disabled)
{
    TEST_ASSERT_EQUAL_HEX32(0, CAN1.ier);
}
