#include "bxcan_model_rig.h"

struct can_wire wire;
struct bxcan can, other;

uint32_t read_register(uint32_t offset)
{
    int64_t value = node_read(&can.node, offset);

    TEST_ASSERT_TRUE_MESSAGE(value >= 0, can.node.refusal);
    return (uint32_t)value;
}

void write_register(uint32_t offset, uint32_t value)
{
    TEST_ASSERT_TRUE_MESSAGE(node_write(&can.node, offset, value), can.node.refusal);
}

void pass_us(uint32_t us)
{
    uint64_t end = wire.now_ns + 1000u * (uint64_t)us, next;

    while ((next = wire_advance(&wire, wire.now_ns)) < end)
        (void)wire_advance(&wire, next);
    (void)wire_advance(&wire, end);
}

void enter_init(struct bxcan *node)
{
    TEST_ASSERT_TRUE(node_write(&node->node, MCR, INRQ));
    pass_us(30);
}

void join(struct bxcan *node, uint32_t mcr)
{
    enter_init(node);
    node->node.clock_hz = CLOCK_HZ;
    TEST_ASSERT_TRUE(node_write(&node->node, BTR, BIT_TIMING));
    TEST_ASSERT_TRUE(node_write(&node->node, FS1R, 1));
    TEST_ASSERT_TRUE(node_write(&node->node, BANK_0, 0) && node_write(&node->node, BANK_0 + 4, 0));
    TEST_ASSERT_TRUE(node_write(&node->node, FA1R, 1) && node_write(&node->node, FMR, 0));
    TEST_ASSERT_TRUE(node_write(&node->node, MCR, mcr));
    pass_us(30);
}

void join_alone(uint32_t mcr)
{
    wire_open(&wire);
    bxcan_open(&can, &wire, 14);
    join(&can, mcr);
}

void request_from(struct bxcan *node, uint32_t mailbox, uint32_t id)
{
    uint32_t base = 0x180 + 0x10 * mailbox;

    TEST_ASSERT_TRUE(node_write(&node->node, base + 0x4, 8) && node_write(&node->node, base + 0x8, 0x04030201));
    TEST_ASSERT_TRUE(node_write(&node->node, base + 0xC, mailbox) && node_write(&node->node, base, id << 21 | 1));
}

void request(uint32_t mailbox, uint32_t id)
{
    request_from(&can, mailbox, id);
}

void deliver(uint32_t id)
{
    TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = id}));
    pass_us(300);
}

uint32_t take_frame(void)
{
    uint32_t id = read_register(OUTPUT_0) >> 21;

    write_register(RF0R, RFOM);
    return id;
}

void assert_heard(unsigned count, const uint32_t ids[])
{
    TEST_ASSERT_EQUAL_UINT(count, wire.heard.count);
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL_HEX32(ids[i], wire.heard.frames[i].id);
}

void join_other(void)
{
    bxcan_open(&other, &wire, 14);
    join(&other, TXFP);
}
