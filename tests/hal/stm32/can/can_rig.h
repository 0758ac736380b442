/* can_rig.h: the link over a CAN controller, on the model of that controller behind registers in the test's memory. What the
 * driver has written there reaches the model, and time passes, whenever the driver asks for the time. bxcan_rig.h and
 * fdcan_rig.h say what differs; a test includes one of them. */
#ifndef OCTET_CAN_RIG_H
#define OCTET_CAN_RIG_H

#include <string.h>

#include "tests/test.h"
#include "hal/stm32/chip.h"
#include "host_sim/emulator/models/can_node.h"

enum { LOOK_US = 50, WORDS_MAX = 256 };   /* from one look at the clock to the next; of a controller */

/* One for each controller. */
struct can_memory {
    struct can_node *node;
    volatile uint32_t *words[2];   /* the registers, and a message RAM or nothing */
    uint32_t count[2];
    uint32_t offset;               /* of that RAM */
    bool (*shows)(uint32_t offset, uint32_t *out);   /* what the driver can read there; false: nothing that changes */
    void (*open)(void);            /* as a boot loader may leave it */
    void (*prepare)(uint32_t offset);   /* the driver has written there */
};

struct rig_bit {
    uint32_t prescaler, before, after, jump;   /* in quanta, the sample point between before and after */
};

/* In the controller's rig. */

extern const struct can_memory CAN_MEMORY;

static struct rig_bit rig_bit(void);
        /* As the driver has set it up. */

static int rig_fifo_for(uint32_t id);
        /* In which of its FIFOs a data frame with this standard identifier would reach the driver, or -1. */

static void rig_open_filters(void);
        /* From here on every frame does. */

static bool rig_is_off_bus(void);
        /* Neither on the bus nor about to join it. */

static struct can_wire wire;
static struct clocks machine;
static uint32_t shown[2][WORDS_MAX];   /* what the driver has read or could have */

static uint32_t offset_of(unsigned part, uint32_t word)
{
    return 4 * word + (part ? CAN_MEMORY.offset : 0);
}

/* The driver can read what the model has. */
static inline void rig_show(void)
{
    for (unsigned part = 0; part < 2; part++)
        for (uint32_t word = 0; word < CAN_MEMORY.count[part]; word++)
            if (CAN_MEMORY.shows(offset_of(part, word), &shown[part][word]))
                CAN_MEMORY.words[part][word] = shown[part][word];
}

/* From the last register to the first: what starts something comes behind what it needs. */
static void take_writes(void)
{
    for (unsigned part = 2; part-- > 0;)
        for (uint32_t word = CAN_MEMORY.count[part]; word-- > 0;) {
            uint32_t value = CAN_MEMORY.words[part][word], offset = offset_of(part, word);

            if (value == shown[part][word])
                continue;
            CAN_MEMORY.prepare(offset);
            TEST_ASSERT_TRUE_MESSAGE(node_write(CAN_MEMORY.node, offset, value), CAN_MEMORY.node->refusal);
            shown[part][word] = value;
        }
}

/* A chip that has just been reset, as its boot loader may leave it, on a quiet bus. */
static inline void rig_reset(void)
{
    memset(shown, 0, sizeof shown);
    wire_open(&wire);
    CAN_MEMORY.open();
    CAN_MEMORY.node->clock_hz = machine.can_hz;
    for (unsigned part = 0; part < 2; part++)
        for (uint32_t word = 0; word < CAN_MEMORY.count[part]; word++)
            shown[part][word] = CAN_MEMORY.words[part][word];
    rig_show();
}

/* What the driver has written takes effect, and time passes. */
static inline void rig_pass_us(uint32_t us)
{
    uint64_t end = wire.now_ns + 1000u * (uint64_t)us, next;

    CAN_MEMORY.node->clock_hz = machine.can_hz;
    take_writes();
    while ((next = wire_advance(&wire, wire.now_ns)) < end)
        (void)wire_advance(&wire, next);
    (void)wire_advance(&wire, end);
    TEST_ASSERT_EQUAL_STRING("", CAN_MEMORY.node->refusal);
    rig_show();
}

static inline uint32_t rig_ms(void)
{
    return (uint32_t)(wire.now_ns / 1000000);
}

uint32_t machine_ms(void)
{
    rig_pass_us(LOOK_US);
    return rig_ms();
}

struct clocks machine_clocks(void)
{
    return machine;
}

static inline void rig_set_clock(uint32_t hz)
{
    machine.can_hz = hz;
}

/* Arrives over the bus. */
static inline void rig_deliver(const struct frame *frame)
{
    TEST_ASSERT_TRUE(wire_put(&wire, frame));
    rig_pass_us(300);
}

static inline unsigned rig_sent_count(void)
{
    return wire.heard.count;
}

/* What has arrived at the other nodes so far. */
static inline const struct frame *rig_sent(unsigned n)
{
    return &wire.heard.frames[n];
}

/* The bus is never idle: nothing can be sent, and it cannot be joined. */
static inline void rig_block(bool blocked)
{
    wire.busy = blocked;
}

/* From here on other nodes send frames of this identifier without a pause, for at least 200 ms. 0: they stop. */
static inline void rig_occupy(uint32_t id)
{
    wire.waiting.count = 0;
    for (unsigned i = 0; id != 0 && i < 1000; i++)
        TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = id, .len = 8}));
    rig_pass_us(0);
}

/* From here on the controller neither sends what it has nor gives it up. */
static inline void rig_stall(void)
{
    CAN_MEMORY.node->stuck_mailboxes = 7;
}

static inline void rig_enter_bus_off(void)
{
    CAN_MEMORY.node->tec = 255;
    node_failed(CAN_MEMORY.node, NODE_BIT_DOMINANT);
    rig_pass_us(0);
}

static inline bool rig_is_bus_off(void)
{
    return CAN_MEMORY.node->bus_off;
}

/* The idle times that end bus-off never come. */
static inline void rig_keep_bus_off(void)
{
    CAN_MEMORY.node->recovery_stuck = true;
}

/* The controller does not answer when it is to leave the bus. */
static inline void rig_stop_answering(void)
{
    CAN_MEMORY.node->init_stuck = true;
}

/* How often the controller has left the bus so far. */
static inline unsigned rig_departures(void)
{
    return CAN_MEMORY.node->inits;
}

static inline void rig_set_errors(uint8_t tx, uint8_t rx, bool passive)
{
    CAN_MEMORY.node->tec = tx;
    CAN_MEMORY.node->rec = passive ? 128 : rx;
    rig_pass_us(0);
}

#endif
