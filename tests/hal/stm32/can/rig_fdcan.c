#include "can_rig.h"

#include "fdcan_model.h"
#include "hal/stm32/fdcan_registers.h"

const uint32_t RIG_CLOCKS_HZ[] = {80000000, 16000000, 0};

void rig_reset(void)
{
    fdcan_reset();
}

void rig_set_clock(uint32_t hz)
{
    fdcan.clocks.can_hz = hz;
}

uint32_t rig_ms(void)
{
    return fdcan.now_us / 1000;
}

void rig_pass_us(uint32_t us)
{
    uint32_t end = fdcan.now_us + us;

    fdcan_step();
    while (fdcan.now_us < end)
        (void)machine_ms();
}

struct rig_bit rig_bit(void)
{
    uint32_t timing = FDCAN.nbtp;

    return (struct rig_bit){(timing >> 16 & 0x1FFu) + 1, (timing >> 8 & 0xFFu) + 2, (timing & 0x7Fu) + 1, (timing >> 25) + 1};
}

void rig_bring(const struct frame *frame)
{
    fdcan_bring(frame);
}

int rig_fifo_for(uint32_t id)
{
    return fdcan_fifo_for(id);
}

/* The model's own filters are asked about, and let everything in. */
void rig_open_filters(void)
{
}

unsigned rig_sent_count(void)
{
    return fdcan.sent_count;
}

const struct frame *rig_sent(unsigned n)
{
    return &fdcan.sent[n];
}

void rig_block(bool blocked)
{
    fdcan.bus_busy = blocked;
}

void rig_occupy(uint32_t id)
{
    fdcan.occupied_by = id;
}

void rig_stick(void)
{
    fdcan.sticks = true;
}

void rig_lose_bus(void)
{
    fdcan.bus_off = true;
    FDCAN.cccr |= 1u;   /* the controller does that */
    fdcan_step();
}

bool rig_has_lost_bus(void)
{
    return fdcan.bus_off;
}

void rig_keep_bus_off(void)
{
    fdcan.stays_off = true;
}

void rig_fall_silent(void)
{
    fdcan.ignores_init = true;
}

unsigned rig_departures(void)
{
    return fdcan.inits;
}

bool rig_is_apart(void)
{
    return FDCAN.cccr & 1u;
}

void rig_set_errors(uint8_t tx, uint8_t rx, bool passive)
{
    FDCAN.ecr = 0x55u << 16 | 1u << 15 | (uint32_t)rx << 8 | tx;
    FDCAN.psr |= passive ? 3u << 5 : 0u;   /* passive, and warned */
}
