#include "fdcan_model.h"

#include <string.h>

#include "hal/stm32/fdcan_registers.h"

enum {
    INIT = 1, CCE = 2, BY_IDENTIFIER = 1 << 24,
    EXTENDED = 1 << 30, REMOTE = 1 << 29,
    NOTHING_READ = 0xFF,        /* no place of the FIFO: the driver has not written RXF0A since */
    NEW = 1 | 1 << 3,           /* in IR, of both FIFOs */
    LOST_0 = 1 << 2, LOST_1 = 1 << 5,
    IDLE = 1 << 3, BUS_OFF_FLAG = 1 << 7
};

volatile struct fdcan_registers FDCAN;
volatile struct fdcan_ram FDCAN_RAM;
struct fdcan_model fdcan;

void fdcan_reset(void)
{
    memset((void *)&FDCAN, 0, sizeof FDCAN);
    memset((void *)&FDCAN_RAM, 0xA5, sizeof FDCAN_RAM);
    memset(&fdcan, 0, sizeof fdcan);
    FDCAN.cccr = INIT;
    FDCAN.nbtp = 0x06000A03;
    FDCAN.psr = 0x707;
    FDCAN.ie = FDCAN.ile = 3;   /* as a boot loader may leave them */
    FDCAN.rxf[0].read = FDCAN.rxf[1].read = NOTHING_READ;
    fdcan.in_init = true;
    fdcan.on_wire = -1;
    fdcan.frame_us = 250;
    fdcan.clocks = (struct clocks){80000000, 80000000, 80000000, true};
    fdcan_step();
}

static void forget_all(void)
{
    FDCAN.txbrp = FDCAN.txbar = 0;
    fdcan.on_wire = -1;
    memset(fdcan.fifos, 0, sizeof fdcan.fifos);
}

static void step_mode(void)
{
    bool wanted = FDCAN.cccr & INIT;

    if (fdcan.ignores_init)
        FDCAN.cccr &= ~(uint32_t)INIT;
    else if (wanted && !fdcan.in_init)
        fdcan.inits++;
    if (!wanted && fdcan.in_init) {
        fdcan.recovering = fdcan.bus_off;
        fdcan.recovering_us = fdcan.now_us;
    }
    fdcan.in_init = wanted && !fdcan.ignores_init;
    fdcan.joined = !fdcan.in_init && !fdcan.bus_off && (fdcan.joined || !fdcan.bus_busy);
    if (fdcan.in_init && FDCAN.cccr & CCE)
        forget_all();
}

static void step_recovery(void)
{
    if (fdcan.recovering && !fdcan.stays_off && fdcan.now_us - fdcan.recovering_us >= MODEL_RECOVERY_US) {
        fdcan.recovering = fdcan.bus_off = false;
        fdcan.bus_offs_recovered++;
    }
    FDCAN.psr = 0x707u | (fdcan.joined ? IDLE : 0u) | (fdcan.bus_off ? BUS_OFF_FLAG : 0u) | (FDCAN.psr & 0x60u);
}

static bool wins(uint32_t id)
{
    return fdcan.occupied_by == 0 || id < fdcan.occupied_by;
}

/* By identifier, and equal ones by number. In a FIFO it would be the oldest, which no driver of ours asks for. */
static int next_to_send(void)
{
    int next = -1;

    for (int n = 0; n < FDCAN_ELEMENTS; n++)
        if (FDCAN.txbrp >> n & 1u && (next < 0 || FDCAN_RAM.sent[n].id < FDCAN_RAM.sent[next].id))
            next = n;
    return next >= 0 && FDCAN.txbc & BY_IDENTIFIER && wins(FDCAN_RAM.sent[next].id >> 18) ? next : -1;
}

static void end_transmission(void)
{
    const volatile struct fdcan_element *element = &FDCAN_RAM.sent[fdcan.on_wire];
    struct frame *frame = &fdcan.sent[fdcan.sent_count++ % MODEL_SENT_MAX];

    *frame = (struct frame){.id = element->id >> 18, .len = (uint8_t)(element->control >> 16 & 15u)};
    memcpy(frame->data, (const void *)element->data, 8);
    FDCAN.txbrp &= ~(1u << fdcan.on_wire);
    fdcan.on_wire = -1;
}

/* A request is given up at once, unless its frame is on the wire: that one is let go to its end. */
static void take_requests(void)
{
    uint32_t under_way = fdcan.on_wire >= 0 ? 1u << fdcan.on_wire : 0u;

    FDCAN.txbrp |= FDCAN.txbar;
    FDCAN.txbrp &= ~(fdcan.sticks ? 0 : FDCAN.txbcr) | under_way;
    FDCAN.txbar = FDCAN.txbcr = 0;
}

static void step_transmit(void)
{
    take_requests();
    if (fdcan.on_wire >= 0 && fdcan.now_us - fdcan.on_wire_us >= fdcan.frame_us)
        end_transmission();
    if (fdcan.on_wire < 0 && fdcan.joined && !fdcan.bus_busy && !fdcan.sticks) {
        fdcan.on_wire = next_to_send();
        fdcan.on_wire_us = fdcan.now_us;
    }
    FDCAN.txfqs = 1u << 21;
    for (unsigned n = FDCAN_ELEMENTS; n-- > 0;)
        if (!(FDCAN.txbrp >> n & 1u))
            FDCAN.txfqs = n << 16;
}

static void step_fifo(unsigned n, uint32_t cleared)
{
    if (FDCAN.rxf[n].read != NOTHING_READ && fdcan.fifos[n].waiting > 0 && FDCAN.rxf[n].read == fdcan.fifos[n].first) {
        fdcan.fifos[n].first = (fdcan.fifos[n].first + 1) % FDCAN_ELEMENTS;
        fdcan.fifos[n].waiting--;
    }
    FDCAN.rxf[n].read = NOTHING_READ;
    if (cleared & (n == 0 ? LOST_0 : LOST_1))
        fdcan.fifos[n].lost = false;
    FDCAN.rxf[n].status = fdcan.fifos[n].waiting | fdcan.fifos[n].first << 8 | (fdcan.fifos[n].lost ? 1u << 25 : 0u);
}

static void step_receive(void)
{
    uint32_t cleared = FDCAN.ir & NEW ? 0 : FDCAN.ir;   /* written: what it shows has NEW as well */

    for (unsigned n = 0; n < 2; n++)
        step_fifo(n, cleared);
    FDCAN.ir = NEW | (fdcan.fifos[0].lost ? LOST_0 : 0u) | (fdcan.fifos[1].lost ? LOST_1 : 0u);
}

void fdcan_step(void)
{
    step_mode();
    step_recovery();
    step_transmit();
    step_receive();
}

static void store(unsigned n, const struct frame *frame)
{
    unsigned place = (fdcan.fifos[n].first + fdcan.fifos[n].waiting++) % FDCAN_ELEMENTS;
    volatile struct fdcan_element *element = &FDCAN_RAM.received[n][place];

    element->id = frame->id & FRAME_EXTENDED ? EXTENDED | (frame->id & 0x1FFFFFFFu) : (frame->id & 0x7FFu) << 18;
    if (frame->id & FRAME_REMOTE)
        element->id |= REMOTE;
    element->control = 0x8100ABCDu | (uint32_t)frame->len << 16;   /* a filter's number and a time stamp that nobody asked for */
    memcpy((void *)element->data, frame->data, 8);
}

void fdcan_bring(const struct frame *frame)
{
    unsigned n = fdcan_fifo_for(frame->id) == 1;

    fdcan_step();
    if (fdcan.fifos[n].waiting == MODEL_FIFO_DEPTH)
        fdcan.fifos[n].lost = true;
    else
        store(n, frame);
    fdcan_step();
}

/* Filters with a mask are all that our driver makes use of. */
int fdcan_fifo_for(uint32_t id)
{
    unsigned filters = FDCAN.rxgfc >> 16 & 31u;

    for (unsigned n = 0; n < filters; n++) {
        uint32_t filter = FDCAN_RAM.standard_filters[n];
        uint32_t to = filter >> 27 & 7u;

        if (filter >> 30 == 2 && ((filter >> 16 ^ id) & filter & 0x7FFu) == 0 && (to == 1 || to == 2))
            return (int)to - 1;
    }
    return FDCAN.rxgfc >> 4 & 2u ? -1 : 0;
}

uint32_t machine_ms(void)
{
    fdcan.now_us += MODEL_LOOK_US;
    fdcan_step();
    return fdcan.now_us / 1000;
}

struct clocks machine_clocks(void)
{
    return fdcan.clocks;
}
