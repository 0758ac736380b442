#include <stddef.h>

#include "tests/test.h"
#include "fdcan_rig.h"
#include "hal/link/link.h"

static const uint16_t WANTED[] = {0x0C1, 0x041};
static struct link *link_here;

void setUp(void)
{
    rig_reset();
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", WANTED, 2));
    rig_pass_us(100);
}

TEST(message_ram_layout_matches_the_manual)
{
    TEST_ASSERT_EQUAL_HEX(0x070, offsetof(struct fdcan_ram, extended_filters));
    TEST_ASSERT_EQUAL_HEX(0x0B0, offsetof(struct fdcan_ram, received[0]));
    TEST_ASSERT_EQUAL_HEX(0x188, offsetof(struct fdcan_ram, received[1]));
    TEST_ASSERT_EQUAL_HEX(0x260, offsetof(struct fdcan_ram, events));
    TEST_ASSERT_EQUAL_HEX(0x278, offsetof(struct fdcan_ram, sent));
    TEST_ASSERT_EQUAL_HEX(0x350, sizeof(struct fdcan_ram));
}

TEST(fdcan_runs_in_classic_mode_with_priority_by_identifier)
{
    TEST_ASSERT_EQUAL_HEX32(0, FDCAN.cccr);
    TEST_ASSERT_EQUAL_HEX32(1 << 24, FDCAN.txbc);
}

TEST(global_filter_rejects_unmatched_frames)
{
    TEST_ASSERT_EQUAL_HEX32(3 | 2 << 2 | 2 << 4, FDCAN.rxgfc & 0xFFFF);
    TEST_ASSERT_EQUAL_HEX32(0, FDCAN.rxgfc >> 24);   /* no extended filters */
}

TEST(filter_accepts_an_odd_number_of_identifiers)
{
    static const uint16_t three[] = {0x0C1, 0x041, 0x7FF};

    rig_reset();
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", three, 3));
    rig_pass_us(100);
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == 0x0C1 || id == 0x041 || id == 0x7FF ? 0 : -1, rig_fifo_for(id));
}

TEST(link_open_clears_earlier_filters_and_loss_flags)
{
    struct frame frame;

    rig_reset();
    for (unsigned n = 0; n < FDCAN_FILTERS; n++)
        can.ram[n] = 2u << 30 | 1u << 27;   /* lets everything in */
    can.ir = 1u << 2 | 1u << 5;
    rig_show();
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", WANTED, 2));
    rig_pass_us(100);
    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, 1));
    for (uint32_t id = 0; id <= 0x7FF; id++)
        TEST_ASSERT_EQUAL(id == WANTED[0] || id == WANTED[1] ? 0 : -1, rig_fifo_for(id));
}

TEST(link_close_discards_waiting_frames)
{
    wire.busy = true;
    TEST_ASSERT_EQUAL(0, link_send(link_here, &(struct frame){.id = 0x041}));
    link_close(link_here);
    rig_pass_us(100);
    TEST_ASSERT_EQUAL_HEX32(0, FDCAN.txbrp);
}

TEST(buffers_are_written_whole)
{
    struct frame frame = {.id = 0x7A5, .len = 8};

    TEST_ASSERT_EQUAL(0, link_send(link_here, &frame));
    TEST_ASSERT_EQUAL_HEX32(0x7A5u << 18, FDCAN_RAM.sent[0].id);
    TEST_ASSERT_EQUAL_HEX32(8u << 16, FDCAN_RAM.sent[0].control);
}

TEST(receive_fifo_wraps_around)
{
    struct frame frame;

    for (uint8_t n = 0; n < 10; n++) {
        rig_deliver(&(struct frame){.id = 0x0C1, .len = 1, .data = {n}});
        TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, 1));
        TEST_ASSERT_EQUAL_UINT8(n, frame.data[0]);
    }
}

TEST(interrupts_stay_disabled)
{
    TEST_ASSERT_EQUAL_HEX32(0, FDCAN.ie | FDCAN.ile);
}
