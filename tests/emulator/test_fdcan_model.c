/* The model of FDCAN against the reference manual (RM0440 44). */
#include <string.h>

#include "tests/test.h"
#include "host_sim/emulator/models/fdcan_model.h"

enum {
    CCCR = 0x018, NBTP = 0x01C, ECR = 0x040, PSR = 0x044, IR = 0x050, IE = 0x054, RXGFC = 0x080, RXF0S = 0x090, RXF0A = 0x094,
    TXBC = 0x0C0, TXFQS = 0x0C4, TXBRP = 0x0C8, TXBAR = 0x0CC, TXBCR = 0x0D0, TXBTO = 0x0D4, TXBCF = 0x0D8,
    INIT = 1, CCE = 2, QUEUE = 1 << 24, EP = 1 << 5, EW = 1 << 6, BO = 1 << 7,
    RECEIVED = FDCAN_RAM_AT + 0xB0, SENT = FDCAN_RAM_AT + 0x278, ELEMENT = 72, BIT_TIMING = 9 << 16 | 12 << 8 | 1,
    FRAME_US = 300, ERROR_US = 80
};

static struct can_wire wire;
static struct fdcan can, other;

#define ASSERT_REFUSED(REASON, ACCESS)                                                                                 \
    do {                                                                                                               \
        can.node.refusal[0] = '\0';                                                                                    \
        (void)(ACCESS);                                                                                                \
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(can.node.refusal, REASON), can.node.refusal);                              \
    } while (0)

static void pass_us(uint32_t us)
{
    uint64_t end = wire.now_ns + 1000u * (uint64_t)us, next;

    while ((next = wire_advance(&wire, wire.now_ns)) < end)
        (void)wire_advance(&wire, next);
    (void)wire_advance(&wire, end);
}

static uint32_t get(uint32_t offset)
{
    int64_t value = node_read(&can.node, offset);

    TEST_ASSERT_TRUE_MESSAGE(value >= 0, can.node.refusal);
    return (uint32_t)value;
}

static void set(struct fdcan *node, uint32_t offset, uint32_t value)
{
    TEST_ASSERT_TRUE_MESSAGE(node_write(&node->node, offset, value), node->node.refusal);
}

/* With a filter of each kind: 0x100..0x1FF to FIFO 0, 0x200 and 0x300 to FIFO 1, 0x480..0x48F nowhere, all else to FIFO 0. */
static void join(struct fdcan *node)
{
    static const uint32_t filters[] = {
        1u << 27 | 0x100u << 16 | 0x1FF, 1u << 30 | 2u << 27 | 0x200u << 16 | 0x300,
        2u << 30 | 3u << 27 | 0x480u << 16 | 0x7F0, 3u << 30 | 1u << 27, 0,
    };

    node->node.clock_hz = 80000000;
    set(node, CCCR, INIT | CCE);
    set(node, NBTP, BIT_TIMING);
    set(node, TXBC, QUEUE);
    set(node, RXGFC, 5u << 16 | 2);   /* five filters, no remote frames */
    for (unsigned n = 0; n < 5; n++)
        set(node, FDCAN_RAM_AT + 4 * n, filters[n]);
    set(node, CCCR, 0);
    pass_us(30);
}

void setUp(void)
{
    wire_open(&wire);
    fdcan_open(&can, &wire);
    join(&can);
}

static void request(struct fdcan *node, uint32_t buffer, uint32_t id)
{
    set(node, SENT + ELEMENT * buffer, id << 18);
    set(node, SENT + ELEMENT * buffer + 4, 8u << 16);
    set(node, SENT + ELEMENT * buffer + 8, 0x04030201);
    set(node, SENT + ELEMENT * buffer + 12, buffer);
    set(node, TXBAR, 1u << buffer);
}

static void deliver(uint32_t id)
{
    TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = id, .len = 5, .data = {1, 2, 3, 4, 5}}));
    pass_us(FRAME_US);
}

TEST(frames_leave_by_identifier_and_equal_ones_by_buffer)
{
    static const uint32_t expected[] = {0x300, 0x100, 0x100};   /* the first was alone when it began */

    request(&can, 2, 0x300);
    pass_us(1);
    request(&can, 1, 0x100);
    request(&can, 0, 0x100);
    TEST_ASSERT_EQUAL_HEX32(1u << 21, get(TXFQS));
    pass_us(3 * FRAME_US);
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_EQUAL_HEX32(expected[i], wire.heard.frames[i].id);
    TEST_ASSERT_EQUAL_UINT8(0, wire.heard.frames[1].data[4]);
    TEST_ASSERT_EQUAL_UINT8(1, wire.heard.frames[2].data[4]);
    TEST_ASSERT_EQUAL_HEX32(0, get(TXBRP) | get(TXFQS));
    TEST_ASSERT_EQUAL_HEX32(7, get(TXBTO));
}

TEST(cancellation_spares_the_frame_on_the_wire)
{
    request(&can, 0, 1);
    request(&can, 1, 2);
    pass_us(1);
    set(&can, TXBCR, 3);
    TEST_ASSERT_EQUAL_HEX32(1, get(TXBRP));
    TEST_ASSERT_EQUAL_HEX32(2, get(TXBCF));
    pass_us(FRAME_US);
    TEST_ASSERT_EQUAL_UINT(1, wire.heard.count);
    TEST_ASSERT_EQUAL_HEX32(1, get(TXBTO));
}

TEST(stuck_buffer_neither_sends_nor_cancels)
{
    can.node.stuck_mailboxes = 1;
    request(&can, 0, 1);
    set(&can, TXBCR, 1);
    pass_us(FRAME_US);
    TEST_ASSERT_EQUAL_HEX32(1, get(TXBRP));
}

TEST(filter_types_select_the_fifo)
{
    static const struct { uint32_t id; int fifo; unsigned filter; } cases[] = {
        {0x0FF, 0, 5}, {0x100, 0, 0}, {0x1FF, 0, 0}, {0x200, 1, 1}, {0x2FF, 0, 5}, {0x300, 1, 1}, {0x480, -1, 2},
        {0x48F, -1, 2}, {0x490, 0, 5}, {FRAME_EXTENDED | 0x100, 0, 0}, {FRAME_REMOTE | 0x100, -1, 5},
    };
    unsigned filter;

    for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
        TEST_ASSERT_EQUAL(cases[i].fifo, fdcan_fifo_for(&can, &(struct frame){.id = cases[i].id}, &filter));
        TEST_ASSERT_EQUAL_UINT(cases[i].filter, filter);
    }
    can.rxgfc |= 2u << 2 | 1u << 4;
    TEST_ASSERT_EQUAL(-1, fdcan_fifo_for(&can, &(struct frame){.id = FRAME_EXTENDED}, &filter));
    TEST_ASSERT_EQUAL(1, fdcan_fifo_for(&can, &(struct frame){.id = 0x7FF}, &filter));
}

TEST(message_ram_holds_frame_until_acknowledged)
{
    deliver(0x123);
    TEST_ASSERT_EQUAL_HEX32(1 | 1u << 16, get(RXF0S));
    TEST_ASSERT_EQUAL_HEX32(0x123u << 18, get(RECEIVED));
    TEST_ASSERT_EQUAL_HEX32(5u << 16, get(RECEIVED + 4) & 0xFF0F0000);
    TEST_ASSERT_EQUAL_HEX32(0x04030201, get(RECEIVED + 8));
    TEST_ASSERT_EQUAL_HEX32(5, get(RECEIVED + 12));
    set(&can, RXF0A, 0);
    TEST_ASSERT_EQUAL_HEX32(1u << 8 | 1u << 16, get(RXF0S));
    deliver(FRAME_EXTENDED | 0x12345);
    TEST_ASSERT_EQUAL_HEX32(1u << 30 | 0x12345, get(RECEIVED + ELEMENT));
    TEST_ASSERT_EQUAL_HEX32(1u << 31, get(RECEIVED + ELEMENT + 4) & 1u << 31);
}

TEST(fifo_overrun_is_flagged_until_it_is_cleared)
{
    for (unsigned n = 0; n < 4; n++)
        deliver(0x100 + n);
    TEST_ASSERT_EQUAL_HEX32(3 | 3u << 24, get(RXF0S));
    TEST_ASSERT_EQUAL_UINT(1, can.node.overruns);
    set(&can, IR, 1u << 2);
    set(&can, RXF0A, 1);
    TEST_ASSERT_EQUAL_HEX32(1 | 2u << 8, get(RXF0S));
    TEST_ASSERT_EQUAL_HEX32(0x102u << 18, get(RECEIVED + 2 * ELEMENT));
}

TEST(errors_lead_to_bus_off_and_leaving_init_ends_it)
{
    static const uint32_t errors[] = {11, 1, 3, 1, 15, 1}, expected[] = {0, EW, EW, EW | EP, EW | EP, EW | EP | BO};

    wire.shorted = true;
    request(&can, 0, 0x81);
    for (unsigned i = 0; i < 6; i++) {
        pass_us(errors[i] * ERROR_US);
        TEST_ASSERT_EQUAL_HEX32(expected[i], get(PSR) & (EW | EP | BO));
    }
    wire.shorted = false;
    TEST_ASSERT_EQUAL_HEX32(INIT, get(CCCR));
    TEST_ASSERT_EQUAL_HEX32(255, get(ECR));
    pass_us(100000);
    set(&can, CCCR, 0);
    pass_us(128 * 22 + 21);
    TEST_ASSERT_EQUAL_HEX32(BO, get(PSR) & BO);
    pass_us(1);
    TEST_ASSERT_EQUAL_HEX32(0, get(ECR) | (get(PSR) & BO));
    pass_us(FRAME_US);
    TEST_ASSERT_EQUAL_UINT(1, wire.heard.count);
}

TEST(psr_shows_activity_and_resets_lec_when_read)
{
    set(&can, CCCR, INIT);
    pass_us(30);
    TEST_ASSERT_EQUAL_HEX32(0, get(PSR) >> 3 & 3);
    set(&can, CCCR, 0);
    pass_us(30);
    TEST_ASSERT_EQUAL_HEX32(1, get(PSR) >> 3 & 3);
    wire.alone = true;
    request(&can, 0, 1);
    pass_us(FRAME_US);
    TEST_ASSERT_EQUAL_HEX32(NODE_NO_ACKNOWLEDGE | 3u << 3, get(PSR) & 0x1F);
    TEST_ASSERT_EQUAL_HEX32(7, get(PSR) & 7);
    can.node.rec = 200;
    TEST_ASSERT_EQUAL_HEX32(1u << 15 | 127u << 8, get(ECR) & 0xFF00);
}

TEST(init_reads_back_late_and_cce_clears_state)
{
    deliver(0x100);
    set(&can, CCCR, INIT);
    TEST_ASSERT_EQUAL_HEX32(0, get(CCCR));
    ASSERT_REFUSED("before INIT was read back", node_write(&can.node, CCCR, INIT | CCE));
    pass_us(30);
    set(&can, CCCR, INIT | CCE);
    TEST_ASSERT_EQUAL_HEX32(INIT | CCE, get(CCCR));
    TEST_ASSERT_EQUAL_HEX32(0, get(RXF0S));
    set(&can, TXBAR, 1);
    TEST_ASSERT_EQUAL_HEX32(0, get(TXBRP));
}

TEST(controllers_receive_from_each_other)
{
    fdcan_open(&other, &wire);
    join(&other);
    wire.alone = true;
    request(&other, 0, 0x123);
    pass_us(FRAME_US);
    TEST_ASSERT_EQUAL_HEX32(1, get(RXF0S) & 15);
    TEST_ASSERT_EQUAL_UINT(0, other.node.tec);
}

TEST(forbidden_and_unmodelled_accesses_are_refused)
{
    request(&can, 0, 1);
    ASSERT_REFUSED("pending", node_write(&can.node, SENT + 4, 0));
    ASSERT_REFUSED("CCE is 0", node_write(&can.node, NBTP, 0));
    ASSERT_REFUSED("only INIT and CCE", node_write(&can.node, CCCR, 1u << 8));
    ASSERT_REFUSED("interrupts", node_write(&can.node, IE, 1));
    ASSERT_REFUSED("holds no frame", node_write(&can.node, RXF0A, 0));
    ASSERT_REFUSED("cannot be", node_write(&can.node, TXFQS, 0));
    ASSERT_REFUSED("no register", node_read(&can.node, 0x024));
    can.ram[0] = 4u << 27 | 2u << 30;
    ASSERT_REFUSED("priority", fdcan_fifo_for(&can, &(struct frame){.id = 1}, &(unsigned){0}));
    can.cccr = INIT | CCE;
    ASSERT_REFUSED("not modelled", node_write(&can.node, RXGFC, 1u << 24));
    set(&can, TXBC, 0);
    can.cccr = 0;
    ASSERT_REFUSED("from a FIFO", node_write(&can.node, TXBAR, 2));
}

TEST(fdcan_refuses_a_bit_rate_other_than_the_bus)
{
    set(&can, CCCR, INIT);
    pass_us(30);
    can.node.clock_hz = 24000000;
    set(&can, CCCR, 0);
    ASSERT_REFUSED("150000 bit/s", pass_us(30));
}
