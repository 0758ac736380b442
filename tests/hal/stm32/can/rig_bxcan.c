#include "can_rig.h"

#include <unity.h>

#include "bxcan_registers.h"
#include "hal/stm32/registers.h"

const uint32_t RIG_CLOCKS_HZ[] = {42000000, 36000000, 32000000, 16000000, 8000000, 0};

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

struct rig_bit rig_bit(void)
{
    uint32_t timing = CAN1.btr;

    return (struct rig_bit){(timing & 0x3FFu) + 1, (timing >> 16 & 15u) + 2, (timing >> 20 & 7u) + 1, (timing >> 24) + 1};
}

void rig_bring(const struct frame *frame)
{
    TEST_ASSERT_TRUE(wire_put(&wire, frame));
    registers_pass_us(300);
}

int rig_fifo_for(uint32_t id)
{
    struct frame frame = {.id = id};

    return bxcan_fifo_for(&can, &frame);
}

void rig_open_filters(void)
{
    can.filters.words[1] = 0;                           /* FM1R: a mask ... */
    can.filters.banks[0] = can.filters.banks[1] = 0;    /* ... that asks for nothing */
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

void rig_stick(void)
{
    can.stuck_mailboxes = 7;
}

void rig_lose_bus(void)
{
    can.bus_off = true;
    registers_pass_us(0);
}

bool rig_has_lost_bus(void)
{
    return can.bus_off;
}

void rig_keep_bus_off(void)
{
    can.recovery_stuck = true;
}

void rig_fall_silent(void)
{
    can.init_stuck = true;
}

unsigned rig_departures(void)
{
    return can.inits;
}

bool rig_is_apart(void)
{
    return CAN1.msr & 1u;
}

void rig_set_errors(uint8_t tx, uint8_t rx, bool passive)
{
    can.tec = tx;
    can.rec = passive ? 128 : rx;
    registers_pass_us(0);
}
