/* What the rigs of all controllers have alike. */
#include "can_rig.h"

#include <unity.h>

#include "can_registers.h"

void rig_reset(void)
{
    registers_reset();
}

void rig_set_clock(uint32_t hz)
{
    machine.can_hz = hz;
}

uint32_t rig_ms(void)
{
    return (uint32_t)(wire.now_ns / 1000000);
}

void rig_pass_us(uint32_t us)
{
    registers_pass_us(us);
}

void rig_deliver(const struct frame *frame)
{
    TEST_ASSERT_TRUE(wire_put(&wire, frame));
    registers_pass_us(300);
}

unsigned rig_sent_count(void)
{
    return wire.heard.count;
}

const struct frame *rig_sent(unsigned n)
{
    return &wire.heard.frames[n];
}

void rig_block(bool blocked)
{
    wire.busy = blocked;
}

void rig_occupy(uint32_t id)
{
    wire.waiting.count = 0;
    for (unsigned i = 0; id != 0 && i < 1000; i++)
        TEST_ASSERT_TRUE(wire_put(&wire, &(struct frame){.id = id, .len = 8}));
    registers_pass_us(0);
}

void rig_stall(void)
{
    CAN_MEMORY.node->stuck_mailboxes = 7;
}

void rig_enter_bus_off(void)
{
    CAN_MEMORY.node->tec = 255;
    node_failed(CAN_MEMORY.node, NODE_BIT_DOMINANT);
    registers_pass_us(0);
}

bool rig_is_bus_off(void)
{
    return CAN_MEMORY.node->bus_off;
}

void rig_keep_bus_off(void)
{
    CAN_MEMORY.node->recovery_stuck = true;
}

void rig_stop_answering(void)
{
    CAN_MEMORY.node->init_stuck = true;
}

unsigned rig_departures(void)
{
    return CAN_MEMORY.node->inits;
}

void rig_set_errors(uint8_t tx, uint8_t rx, bool passive)
{
    CAN_MEMORY.node->tec = tx;
    CAN_MEMORY.node->rec = passive ? 128 : rx;
    registers_pass_us(0);
}
