/* bxcan_model_rig.h: a model of bxCAN on a wire, for its tests. */
#ifndef OCTET_BXCAN_MODEL_RIG_H
#define OCTET_BXCAN_MODEL_RIG_H

#include <string.h>

#include "tests/test.h"
#include "host_sim/emulator/models/bxcan_model.h"

enum {
    MCR = 0x00, MSR = 0x04, TSR = 0x08, RF0R = 0x0C, RF1R = 0x10, IER = 0x14, ESR = 0x18, BTR = 0x1C,
    OUTPUT_0 = 0x1B0, FMR = 0x200, FM1R = 0x204, FS1R = 0x20C, FFA1R = 0x214, FA1R = 0x21C, BANK_0 = 0x240,
    INRQ = 1, TXFP = 4, RFLM = 8, NART = 0x10, ABOM = 0x40, INAK = 1, SLAK = 2,
    RQCP = 1, TXOK = 2, ALST = 4, TERR = 8, ABRQ = 0x80, TME_ALL = 7 << 26,
    FULL = 8, FOVR = 0x10, RFOM = 0x20, EWGF = 1, EPVF = 2, BOFF = 4,
    CLOCK_HZ = 42000000, BIT_TIMING = 9 << 16 | 2 << 20 | 5,   /* 42 MHz / 6 / (1 + 10 + 3) quanta */
    ERROR_US = 80, RECOVERY_US = 128 * 22
};

static struct can_wire wire;
static struct bxcan can, other;

#define ASSERT_HEARD(...) \
    assert_heard(sizeof((uint32_t[]){__VA_ARGS__}) / sizeof(uint32_t), (const uint32_t[]){__VA_ARGS__})
#define ASSERT_REFUSED(REASON, ACCESS)                                                                                 \
    do {                                                                                                               \
        can.node.refusal[0] = '\0';                                                                                         \
        (void)(ACCESS);                                                                                                \
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(can.node.refusal, REASON), can.node.refusal);                                        \
    } while (0)

/* A register of `can`; a refusal fails the test. */
static inline uint32_t read_register(uint32_t offset)
{
    int64_t value = node_read(&can.node, offset);

    TEST_ASSERT_TRUE_MESSAGE(value >= 0, can.node.refusal);
    return (uint32_t)value;
}

static inline void write_register(uint32_t offset, uint32_t value)
{
    TEST_ASSERT_TRUE_MESSAGE(node_write(&can.node, offset, value), can.node.refusal);
}

/* Lets time pass on the wire. */
static inline void pass_us(uint32_t us)
{
    uint64_t end = wire.now_ns + 1000u * (uint64_t)us, next;

    while ((next = wire_advance(&wire, wire.now_ns)) < end)
        (void)wire_advance(&wire, next);
    (void)wire_advance(&wire, end);
}

/* Asks for init and waits for it. */
static inline void enter_init(struct bxcan *node)
{
    TEST_ASSERT_TRUE(node_write(&node->node, MCR, INRQ));
    pass_us(30);
}

/* Enters init, opens all filters, and leaves init for the bus. */
static inline void join(struct bxcan *node, uint32_t mcr)
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

/* A new wire, with `can` alone on it. */
static inline void join_alone(uint32_t mcr)
{
    wire_open(&wire);
    bxcan_open(&can, &wire, 14);
    join(&can, mcr);
}

/* Fills a mailbox and asks for it to be sent. */
static inline void request_from(struct bxcan *node, uint32_t mailbox, uint32_t id)
{
    uint32_t base = 0x180 + 0x10 * mailbox;

    TEST_ASSERT_TRUE(node_write(&node->node, base + 0x4, 8) && node_write(&node->node, base + 0x8, 0x04030201));
    TEST_ASSERT_TRUE(node_write(&node->node, base + 0xC, mailbox) && node_write(&node->node, base, id << 21 | 1));
}

/* request_from(&can, ...). */
static inline void request(uint32_t mailbox, uint32_t id)
{
    request_from(&can, mailbox, id);
}

/* Sends a frame from the world, and lets 300 us pass for it to arrive. */
static inline void deliver(uint32_t id)
{
    TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = id}));
    pass_us(300);
}

/* Takes the next frame out of FIFO 0, and returns its identifier. */
static inline uint32_t take_frame(void)
{
    uint32_t id = read_register(OUTPUT_0) >> 21;

    write_register(RF0R, RFOM);
    return id;
}

/* Checks that the world received exactly these, in this order. */
static inline void assert_heard(unsigned count, const uint32_t ids[])
{
    TEST_ASSERT_EQUAL_UINT(count, wire.heard.count);
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL_HEX32(ids[i], wire.heard.frames[i].id);
}

/* `other` joins the same bus. */
static inline void join_other(void)
{
    bxcan_open(&other, &wire, 14);
    join(&other, TXFP);
}

#endif
