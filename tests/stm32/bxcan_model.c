#include "bxcan_model.h"

#include <string.h>

#include "hal/stm32/registers.h"

enum {
    MCR_INRQ = 1, MCR_SLEEP = 2, MCR_TXFP = 4,
    TXRQ = 1,
    FMP = 3, FULL = 8, FOVR = 16, RFOM = 32
};

volatile struct can_registers CAN1;
struct bxcan_model bxcan;

void bxcan_reset(void)
{
    memset((void *)&CAN1, 0, sizeof CAN1);
    memset((void *)CAN1.sent, 0xA5, sizeof CAN1.sent);
    for (unsigned n = 0; n < 3; n++)
        CAN1.sent[n].id &= ~(uint32_t)TXRQ;   /* the only bit that has a reset value */
    memset((void *)CAN1.bank, 0xA5, sizeof CAN1.bank);
    CAN1.mcr = 0x00010002;
    CAN1.msr = 0x00000C02;
    CAN1.tsr = 0x1C000000;
    CAN1.fmr = 0x2A1C0E01;
    CAN1.fs1r = CAN1.ffa1r = CAN1.ier = 0xFF;   /* as a boot loader may leave them */
    memset(&bxcan, 0, sizeof bxcan);
    bxcan.clocks = (struct clocks){72000000, 36000000, 72000000, true};
}

static bool in_init(void)
{
    return CAN1.msr & 1u;
}

static void step_mode(void)
{
    bool wanted = CAN1.mcr & MCR_INRQ;

    if (wanted && !in_init() && !bxcan.ignores_init) {
        CAN1.msr |= 1u;
        bxcan.inits++;
    }
    if (!wanted && in_init() && !bxcan.bus_busy) {
        CAN1.msr &= ~1u;
        bxcan.recovering = bxcan.bus_off;
        bxcan.recovering_us = bxcan.now_us;
    }
    if (bxcan.recovering && !bxcan.stays_off && bxcan.now_us - bxcan.recovering_us >= MODEL_RECOVERY_US) {
        bxcan.recovering = bxcan.bus_off = false;
        bxcan.bus_offs_recovered++;
    }
    CAN1.esr = (CAN1.esr & ~4u) | (bxcan.bus_off ? 4u : 0u);
}

static void take_requests(void)
{
    for (unsigned n = 0; n < 3; n++)
        if (CAN1.sent[n].id & TXRQ && !bxcan.pending[n]) {
            bxcan.pending[n] = true;
            bxcan.request[n] = bxcan.requests++;
        }
}

static void drop(unsigned n)
{
    bxcan.pending[n] = false;
    CAN1.sent[n].id &= ~(uint32_t)TXRQ;
}

static void take_aborts(void)
{
    for (unsigned n = 0; n < 3; n++)
        if (CAN1.tsr & 0x80u << 8 * n && bxcan.pending[n]) {
            drop(n);
            bxcan.aborted++;
        }
}

/* By time of request with TXFP, else by identifier and then by number. */
static bool goes_before(unsigned a, unsigned b)
{
    uint32_t id_a = CAN1.sent[a].id >> 21, id_b = CAN1.sent[b].id >> 21;

    if (CAN1.mcr & MCR_TXFP)
        return bxcan.request[a] < bxcan.request[b];
    return id_a < id_b || (id_a == id_b && a < b);
}

static int next_to_send(void)
{
    int next = -1;

    for (unsigned n = 0; n < 3; n++)
        if (bxcan.pending[n] && (next < 0 || goes_before(n, (unsigned)next)))
            next = (int)n;
    return next;
}

static void send_from(unsigned n)
{
    struct frame *frame = &bxcan.sent[bxcan.sent_count++ % MODEL_SENT_MAX];

    *frame = (struct frame){.id = CAN1.sent[n].id >> 21, .len = (uint8_t)(CAN1.sent[n].length & 15u)};
    memcpy(frame->data, (const void *)CAN1.sent[n].data, 8);
    drop(n);
}

static void step_transmit(void)
{
    int next;

    take_requests();
    take_aborts();
    while (!bxcan.bus_busy && !bxcan.bus_off && !in_init() && (next = next_to_send()) >= 0)
        send_from((unsigned)next);
    CAN1.tsr = 0;
    for (unsigned n = 0; n < 3; n++)
        if (!bxcan.pending[n])
            CAN1.tsr |= 1u << (26 + n);
}

static void show_first(void)
{
    const struct frame *frame = &bxcan.waiting[0];
    volatile struct can_mailbox *shown = &CAN1.received[0];

    shown->id = frame->id & FRAME_EXTENDED ? (frame->id & 0x1FFFFFFFu) << 3 | 4u : (frame->id & 0x7FFu) << 21;
    if (frame->id & FRAME_REMOTE)
        shown->id |= 2u;
    shown->length = 0xABCD0000u | frame->len;   /* a time stamp that nobody asked for */
    memcpy((void *)shown->data, frame->data, 8);
}

static void release_first(void)
{
    if (bxcan.waiting_count > 0)
        memmove(&bxcan.waiting[0], &bxcan.waiting[1], --bxcan.waiting_count * sizeof bxcan.waiting[0]);
}

static void step_receive(void)
{
    uint32_t written = CAN1.rf0r != bxcan.fifo_shown ? CAN1.rf0r : 0;
    bool waits = bxcan.releases_slowly && written & RFOM;

    if (written & FOVR)
        bxcan.overrun = false;
    if (bxcan.releasing || (written & RFOM && !waits))
        release_first();
    bxcan.releasing = waits;
    if (bxcan.waiting_count > 0)
        show_first();
    CAN1.rf0r = bxcan.waiting_count | (bxcan.waiting_count == MODEL_FIFO_DEPTH ? FULL : 0u) | (bxcan.overrun ? FOVR : 0u)
                | (waits ? RFOM : 0u);
    bxcan.fifo_shown = CAN1.rf0r;
}

void bxcan_step(void)
{
    step_mode();
    step_transmit();
    step_receive();
}

void bxcan_bring(const struct frame *frame)
{
    bxcan_step();
    if (bxcan.waiting_count == MODEL_FIFO_DEPTH)
        bxcan.overrun = true;
    else
        bxcan.waiting[bxcan.waiting_count++] = *frame;
    bxcan_step();
}

static bool half_passes(unsigned bank, unsigned half, uint32_t id)
{
    uint32_t both = CAN1.bank[bank][half];

    return (both & 0xFFFFu) == id << 5 || both >> 16 == id << 5;
}

bool bxcan_filter_passes(uint32_t id)
{
    bool passes = false;

    for (unsigned bank = 0; bank < 14; bank++)
        if (CAN1.fa1r & CAN1.fm1r & ~CAN1.fs1r & ~CAN1.ffa1r & 1u << bank)
            passes = passes || half_passes(bank, 0, id) || half_passes(bank, 1, id);
    return passes && !(CAN1.fmr & 1u);
}

uint32_t machine_ms(void)
{
    bxcan.now_us += MODEL_LOOK_US;
    bxcan_step();
    return bxcan.now_us / 1000;
}

struct clocks machine_clocks(void)
{
    return bxcan.clocks;
}
