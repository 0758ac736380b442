/* Modes, error counters and bus-off of the bxCAN, after ISO 11898-1. */
#include "host_sim/emulator/models/bxcan_parts.h"

#include <stdarg.h>
#include <stdio.h>

enum {
    INRQ = 1 << 0, SLEEP = 1 << 1,       /* of MCR */
    EWGF = 1 << 0, EPVF = 1 << 1, BOFF = 1 << 2,
    WARNING = 96,
    IDLE_NS = 11 * WIRE_BIT_NS,          /* 11 recessive bits: the bus is idle, and can be joined or left */
    RECOVERY_NS = 128 * IDLE_NS
};

bool bxcan_refuse(struct bxcan *can, const char *format, ...)
{
    va_list details;

    va_start(details, format);
    (void)vsnprintf(can->refusal, sizeof can->refusal, format, details);
    va_end(details);
    return false;
}

void bxcan_ask_mode(struct bxcan *can)
{
    enum bxcan_mode wanted = can->mcr & SLEEP ? BXCAN_SLEEP : can->mcr & INRQ ? BXCAN_INIT : BXCAN_NORMAL;

    if (wanted == can->wanted)
        return;
    can->wanted = wanted;
    can->mode_ns = wanted == BXCAN_INIT && can->init_stuck ? BXCAN_NEVER : can->wire->now_ns + IDLE_NS;
}

void bxcan_recover(struct bxcan *can)
{
    can->recovery_ns = can->recovery_stuck ? BXCAN_NEVER : can->wire->now_ns + RECOVERY_NS;
}

/* The bit rate must be within 0.5 % of the bus's. */
static void join(struct bxcan *can)
{
    uint32_t quanta = 1 + (can->btr >> 16 & 15u) + 1 + (can->btr >> 20 & 7u) + 1;
    uint32_t rate = can->clock_hz / ((can->btr & 0x3FFu) + 1) / quanta;

    if (rate > WIRE_BITRATE + WIRE_BITRATE / 200 || rate < WIRE_BITRATE - WIRE_BITRATE / 200)
        (void)bxcan_refuse(can, "CAN1 was set up for %u bit/s, on a bus of %d", (unsigned)rate, WIRE_BITRATE);
    if (can->bus_off)   /* leaving init is how a driver asks for the end of bus-off */
        bxcan_recover(can);
}

uint64_t bxcan_advance_mode(struct bxcan *can)
{
    uint64_t now = can->wire->now_ns;
    bool blocked = can->wire->busy && can->wanted == BXCAN_NORMAL;

    if (can->mode_ns <= now && !blocked) {
        can->mode = can->wanted;
        can->mode_ns = BXCAN_NEVER;
        can->inits += can->mode == BXCAN_INIT;
        if (can->mode == BXCAN_NORMAL)
            join(can);
    }
    if (can->recovery_ns <= now) {
        can->recovery_ns = BXCAN_NEVER;
        can->tec = can->rec = can->last_error = 0;
        can->bus_off = false;
    }
    if (blocked)
        return can->recovery_ns;
    return can->mode_ns < can->recovery_ns ? can->mode_ns : can->recovery_ns;
}

bool bxcan_is_passive(const struct bxcan *can)
{
    return can->tec >= BXCAN_PASSIVE || can->rec >= BXCAN_PASSIVE;
}

uint32_t bxcan_error_status(const struct bxcan *can)
{
    uint32_t flags = can->tec >= WARNING || can->rec >= WARNING ? EWGF : 0;
    uint32_t tec = can->tec < 255 ? can->tec : 255, rec = can->rec < 255 ? can->rec : 255;

    flags |= bxcan_is_passive(can) ? EPVF : 0u;
    flags |= can->bus_off ? BOFF : 0u;
    return flags | can->last_error << 4 | tec << 16 | rec << 24;
}
