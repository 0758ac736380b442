#include "host_sim/emulator/models/bxcan_model.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define NEVER UINT64_MAX

enum {
    MCR = 0x00, MSR = 0x04, TSR = 0x08, RF0R = 0x0C, RF1R = 0x10, IER = 0x14, ESR = 0x18, BTR = 0x1C,
    MAILBOX_0 = 0x180, OUTPUT_0 = 0x1B0, OUTPUT_END = 0x1D0,
    FMR = 0x200, FA1R = 0x21C, FILTERS_END = 0x240, BANK_0 = 0x240,

    INRQ = 1 << 0, SLEEP = 1 << 1, TXFP = 1 << 2, RFLM = 1 << 3, NART = 1 << 4, ABOM = 1 << 6, MASTER_RESET = 1 << 15,
    MCR_RESET = 0x00010002, MSR_LEVELS = 0xC00, BTR_RESET = 0x01230000, FMR_RESET = 0x2A1C0E01,
    RQCP = 1 << 0, TXOK = 1 << 1, ALST = 1 << 2, TERR = 1 << 3, ABRQ = 1 << 7,
    TXRQ = 1 << 0, RTR = 1 << 1, IDE = 1 << 2,
    FULL = 1 << 3, FOVR = 1 << 4, RFOM = 1 << 5,
    EWGF = 1 << 0, EPVF = 1 << 1, BOFF = 1 << 2,
    FINIT = 1 << 0,

    WARNING = 96, PASSIVE = 128, BUS_OFF_COUNT = 256, PENALTY = 8, REC_AFTER_PASSIVE = 120,
    IDLE_NS = 11 * WIRE_BIT_NS,          /* recessive for so long, a bus is idle: to join, or to leave */
    RECOVERY_NS = 128 * IDLE_NS,
    SLOW_RELEASE_NS = 100000
};

static const uint32_t UNDEFINED = 0xA5A5A5A5u, UNDEFINED_TIME = 0xABCD0000u;

static bool refuse(struct bxcan *can, const char *format, ...)
{
    va_list details;

    va_start(details, format);
    (void)vsnprintf(can->refusal, sizeof can->refusal, format, details);
    va_end(details);
    return false;
}

void bxcan_open(struct bxcan *can, struct can_wire *wire, unsigned bank_count)
{
    memset(can, 0, sizeof *can);
    can->wire = wire;
    can->bank_count = bank_count;
    wire->nodes[wire->node_count++] = can;
    bxcan_reset(can);
}

void bxcan_reset(struct bxcan *can)
{
    can->mcr = MCR_RESET;
    can->btr = BTR_RESET;
    can->ier = 0;
    can->mode = can->wanted = BXCAN_SLEEP;
    can->mode_ns = can->recovery_ns = NEVER;
    can->tec = can->rec = can->last_error = 0;
    can->bus_off = false;
    can->on_wire = -1;
    memset(can->fifos, 0, sizeof can->fifos);
    memset(can->mailboxes, 0, sizeof can->mailboxes);
    for (unsigned n = 0; n < BXCAN_MAILBOXES; n++) {
        memset(can->mailboxes[n].words, 0xA5, sizeof can->mailboxes[n].words);
        can->mailboxes[n].words[0] = UNDEFINED & ~(uint32_t)TXRQ;
    }
    memset(&can->filters, 0, sizeof can->filters);
    memset(can->filters.banks, 0xA5, sizeof can->filters.banks);
    can->filters.words[0] = FMR_RESET;
}

static void release(struct bxcan_fifo *fifo)
{
    fifo->flags &= ~(uint32_t)RFOM;
    memmove(&fifo->frames[0], &fifo->frames[1], --fifo->count * sizeof fifo->frames[0]);
}

/* ---- modes */

static void ask_mode(struct bxcan *can)
{
    enum bxcan_mode wanted = can->mcr & SLEEP ? BXCAN_SLEEP : can->mcr & INRQ ? BXCAN_INIT : BXCAN_NORMAL;

    if (wanted == can->wanted)
        return;
    can->wanted = wanted;
    can->mode_ns = wanted == BXCAN_INIT && can->init_stuck ? NEVER : can->wire->now_ns + IDLE_NS;
}

static void recover(struct bxcan *can)
{
    can->recovery_ns = can->recovery_stuck ? NEVER : can->wire->now_ns + RECOVERY_NS;
}

/* The bit rate must be within 0.5 % of the bus's. */
static void join(struct bxcan *can)
{
    uint32_t quanta = 1 + (can->btr >> 16 & 15u) + 1 + (can->btr >> 20 & 7u) + 1;
    uint32_t rate = can->clock_hz / ((can->btr & 0x3FFu) + 1) / quanta;

    if (rate > WIRE_BITRATE + WIRE_BITRATE / 200 || rate < WIRE_BITRATE - WIRE_BITRATE / 200)
        (void)refuse(can, "CAN1 was set up for %u bit/s, on a bus of %d", (unsigned)rate, WIRE_BITRATE);
    if (can->bus_off)   /* leaving init is how a driver asks for the end of bus-off */
        recover(can);
}

uint64_t bxcan_advance(struct bxcan *can)
{
    uint64_t now = can->wire->now_ns;
    bool blocked = can->wire->busy && can->wanted == BXCAN_NORMAL;

    for (unsigned n = 0; n < 2; n++)
        if (can->fifos[n].flags & RFOM && can->fifos[n].release_ns <= now)
            release(&can->fifos[n]);
    if (can->mode_ns <= now && !blocked) {
        can->mode = can->wanted;
        can->mode_ns = NEVER;
        can->inits += can->mode == BXCAN_INIT;
        if (can->mode == BXCAN_NORMAL)
            join(can);
    }
    if (can->recovery_ns <= now) {
        can->recovery_ns = NEVER;
        can->tec = can->rec = can->last_error = 0;
        can->bus_off = false;
    }
    if (blocked)
        return can->recovery_ns;
    return can->mode_ns < can->recovery_ns ? can->mode_ns : can->recovery_ns;
}

/* ---- errors, after ISO 11898-1 */

static bool is_passive(const struct bxcan *can)
{
    return can->tec >= PASSIVE || can->rec >= PASSIVE;
}

static uint32_t error_status(const struct bxcan *can)
{
    uint32_t flags = can->tec >= WARNING || can->rec >= WARNING ? EWGF : 0;
    uint32_t tec = can->tec < 255 ? can->tec : 255, rec = can->rec < 255 ? can->rec : 255;

    flags |= is_passive(can) ? EPVF : 0u;
    flags |= can->bus_off ? BOFF : 0u;
    return flags | can->last_error << 4 | tec << 16 | rec << 24;
}

/* ---- sending */

static void end(struct bxcan *can, unsigned n, uint32_t status)
{
    struct bxcan_mailbox *box = &can->mailboxes[n];

    box->pending = box->aborting = false;
    box->status = RQCP | status;
    box->words[0] &= ~(uint32_t)TXRQ;
}

static struct frame frame_in(const struct bxcan_mailbox *box)
{
    uint32_t id = box->words[0];
    struct frame frame = {.id = id & IDE ? FRAME_EXTENDED | id >> 3 : id >> 21};
    uint32_t len = box->words[1] & 15u;

    frame.len = (uint8_t)(len < 8 ? len : 8);
    if (id & RTR)
        frame.id |= FRAME_REMOTE;
    for (unsigned i = 0; i < 8 && i < len; i++)
        frame.data[i] = (uint8_t)(box->words[2 + i / 4] >> 8 * (i % 4));
    return frame;
}

/* By time of request with TXFP, else by identifier and then by number. */
static bool goes_before(const struct bxcan *can, unsigned a, unsigned b)
{
    const struct bxcan_mailbox *boxes = can->mailboxes;
    uint32_t id_a = boxes[a].words[0] & ~(uint32_t)TXRQ, id_b = boxes[b].words[0] & ~(uint32_t)TXRQ;

    if (can->mcr & TXFP)
        return boxes[a].request < boxes[b].request;
    return id_a < id_b || (id_a == id_b && a < b);
}

/* The first or the last to send of the pending mailboxes that `mask` has; -1: none. */
static int pick(const struct bxcan *can, unsigned mask, bool last)
{
    int picked = -1;

    for (unsigned n = 0; n < BXCAN_MAILBOXES; n++)
        if (can->mailboxes[n].pending && mask >> n & 1u && (picked < 0 || goes_before(can, n, (unsigned)picked) != last))
            picked = (int)n;
    return picked;
}

bool bxcan_listens(const struct bxcan *can)
{
    return can->mode == BXCAN_NORMAL && !can->bus_off;
}

bool bxcan_offer(struct bxcan *can, struct frame *out)
{
    can->on_wire = pick(can, ~can->stuck_mailboxes, false);
    if (can->on_wire < 0)
        return false;
    *out = frame_in(&can->mailboxes[can->on_wire]);
    return true;
}

static void try_again(struct bxcan *can, uint32_t status)
{
    int n = can->on_wire;

    can->on_wire = -1;
    if (n >= 0 && (can->mcr & NART || can->mailboxes[n].aborting))
        end(can, (unsigned)n, status);
}

void bxcan_lost_arbitration(struct bxcan *can)
{
    try_again(can, ALST);
}

void bxcan_sent(struct bxcan *can)
{
    can->tec -= can->tec > 0;
    can->last_error = 0;
    if (can->on_wire >= 0)
        end(can, (unsigned)can->on_wire, TXOK);
    can->on_wire = -1;
}

/* A frame that nobody acknowledges takes a lone node no farther than passive. */
void bxcan_failed(struct bxcan *can, enum bxcan_error error)
{
    can->last_error = error;
    if (error != BXCAN_NO_ACKNOWLEDGE || !is_passive(can))
        can->tec += PENALTY;
    if (can->tec >= BUS_OFF_COUNT && !can->bus_off) {
        can->bus_off = true;
        if (can->mcr & ABOM)
            recover(can);
    }
    try_again(can, TERR);
}

static uint32_t transmit_status(const struct bxcan *can)
{
    int last = pick(can, 7, true);
    uint32_t status = 0, pending = 0, free_box = BXCAN_MAILBOXES;

    for (unsigned n = BXCAN_MAILBOXES; n-- > 0;) {
        status |= can->mailboxes[n].status << 8 * n;
        pending |= can->mailboxes[n].pending ? 1u << n : 0u;
        free_box = can->mailboxes[n].pending ? free_box : n;
    }
    status |= (free_box < BXCAN_MAILBOXES ? free_box : (uint32_t)last) << 24 | (~pending & 7u) << 26;
    return pending & (pending - 1) ? status | 1u << (29 + last) : status;   /* LOW means something among several */
}

/* A request is given up at once, unless its frame is on the wire: that one is let go to its end. */
static void write_tsr(struct bxcan *can, uint32_t value)
{
    for (unsigned n = 0; n < BXCAN_MAILBOXES; n++) {
        struct bxcan_mailbox *box = &can->mailboxes[n];
        uint32_t written = value >> 8 * n & 0xFFu;

        box->status &= written & RQCP ? 0u : ~written;
        if (!(written & ABRQ) || !box->pending)
            continue;
        box->aborting = true;
        if ((int)n != can->on_wire && !(can->stuck_mailboxes >> n & 1u))
            end(can, n, 0);
    }
}

static bool write_mailbox(struct bxcan *can, uint32_t at, uint32_t value)
{
    unsigned n = at / 16;
    struct bxcan_mailbox *box = &can->mailboxes[n];

    if (box->pending)
        return refuse(can, "CAN1 transmit mailbox %u was written while its frame is pending", n);
    box->words[at / 4 % 4] = value;
    if (at % 16 == 0 && value & TXRQ) {
        box->pending = true;
        box->status = 0;
        box->request = can->requests++;
    }
    return true;
}

/* ---- receiving */

/* A full FIFO keeps what it has with RFLM; otherwise the newest frame takes the place of the one before. */
static void store(struct bxcan *can, struct bxcan_fifo *fifo, const struct frame *frame)
{
    if (fifo->count == BXCAN_FIFO_DEPTH) {
        fifo->flags |= FOVR;
        fifo->overruns++;
        if (can->mcr & RFLM)
            return;
        fifo->count--;
    }
    fifo->frames[fifo->count++] = *frame;
    if (fifo->count == BXCAN_FIFO_DEPTH)
        fifo->flags |= FULL;
}

void bxcan_arrived(struct bxcan *can, const struct frame *frame, bool destroyed)
{
    int number = bxcan_fifo_for(can, frame);

    if (destroyed) {
        can->rec++;
        return;
    }
    can->rec = can->rec >= PASSIVE ? REC_AFTER_PASSIVE : can->rec - (can->rec > 0);
    can->last_error = 0;
    if (number >= 0)
        store(can, &can->fifos[number], frame);
}

static void write_rfr(const struct bxcan *can, struct bxcan_fifo *fifo, uint32_t value)
{
    fifo->flags &= ~(value & (FULL | FOVR));
    if (!(value & RFOM) || fifo->count == 0)
        return;
    if (can->release_slow) {
        fifo->flags |= RFOM;
        fifo->release_ns = can->wire->now_ns + SLOW_RELEASE_NS;
    } else {
        release(fifo);
    }
}

static uint32_t word_at(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* The output mailbox of a FIFO. Nobody asked for a time stamp, so it may be anything. */
static int64_t read_output(struct bxcan *can, uint32_t at)
{
    const struct bxcan_fifo *fifo = &can->fifos[at / 16];
    const struct frame *frame = &fifo->frames[0];
    uint32_t remote = frame->id & FRAME_REMOTE ? RTR : 0;

    if (fifo->count == 0) {
        (void)refuse(can, "the output mailbox of CAN1 FIFO %u was read, but the FIFO is empty", (unsigned)at / 16);
        return -1;
    }
    switch (at / 4 % 4) {
    case 0:
        return (frame->id & FRAME_EXTENDED ? (frame->id & 0x1FFFFFFFu) << 3 | IDE : frame->id << 21) | remote;
    case 1:
        return UNDEFINED_TIME | frame->len;
    default:
        return word_at(&frame->data[at % 16 - 8]);
    }
}

/* ---- registers */

static bool write_mcr(struct bxcan *can, uint32_t value)
{
    if (value & MASTER_RESET) {
        bxcan_reset(can);
        return true;
    }
    can->mcr = value;
    ask_mode(can);
    return true;
}

static bool write_btr(struct bxcan *can, uint32_t value)
{
    if (can->mode != BXCAN_INIT)
        return refuse(can, "CAN1 BTR was written outside set-up");
    if (value >> 30)
        return refuse(can, "CAN1 was set to loop back or silence, which is not modelled");
    can->btr = value;
    return true;
}

static bool write_filters(struct bxcan *can, uint32_t offset, uint32_t value)
{
    static const char *const names[] = {"FMR", "FM1R", "", "FS1R", "", "FFA1R", "", "FA1R", ""};
    bool in_init = can->filters.words[0] & FINIT;
    uint32_t at = (offset - FMR) / 4, bank = (offset - BANK_0) / 8;

    if (offset >= BANK_0) {
        if (!in_init && can->filters.words[(FA1R - FMR) / 4] >> bank & 1u)
            return refuse(can, "CAN1 F%uR%u was written while its filter is active", (unsigned)bank, offset / 4 % 2 + 1u);
        can->filters.banks[(offset - BANK_0) / 4] = value;
        return true;
    }
    if (!in_init && offset != FMR && offset != FA1R)
        return refuse(can, "CAN1 %s was written outside the filters' set-up (FMR FINIT)", names[at]);
    can->filters.words[at] = value;
    return true;
}

static bool is_filter(const struct bxcan *can, uint32_t offset)
{
    bool named = offset == FMR || (offset > FMR && offset <= FA1R && offset / 4 % 2 == 1);

    return named || (offset >= BANK_0 && offset < BANK_0 + 8 * can->bank_count);
}

int64_t bxcan_read(struct bxcan *can, uint32_t offset)
{
    if (offset >= MAILBOX_0 && offset < OUTPUT_0)
        return can->mailboxes[(offset - MAILBOX_0) / 16].words[offset / 4 % 4];
    if (offset >= OUTPUT_0 && offset < OUTPUT_END)
        return read_output(can, offset - OUTPUT_0);
    if (is_filter(can, offset))
        return offset < BANK_0 ? can->filters.words[(offset - FMR) / 4] : can->filters.banks[(offset - BANK_0) / 4];
    switch (offset) {
    case MCR:
        return can->mcr;
    case MSR:
        return can->mode | MSR_LEVELS;
    case TSR:
        return transmit_status(can);
    case RF0R:
    case RF1R:
        return can->fifos[(offset - RF0R) / 4].count | can->fifos[(offset - RF0R) / 4].flags;
    case IER:
        return can->ier;
    case ESR:
        return error_status(can);
    case BTR:
        return can->btr;
    default:
        (void)refuse(can, "CAN1 has no register at 0x%03X", (unsigned)offset);
        return -1;
    }
}

bool bxcan_write(struct bxcan *can, uint32_t offset, uint32_t value)
{
    if (offset >= MAILBOX_0 && offset < OUTPUT_0)
        return write_mailbox(can, offset - MAILBOX_0, value);
    if (offset >= OUTPUT_0 && offset < OUTPUT_END)
        return refuse(can, "the output mailbox of CAN1 FIFO %u was written, which is read-only",
                      (unsigned)(offset - OUTPUT_0) / 16);
    if (is_filter(can, offset))
        return write_filters(can, offset, value);
    switch (offset) {
    case MCR:
        return write_mcr(can, value);
    case MSR:
        return true;
    case TSR:
        write_tsr(can, value);
        return true;
    case RF0R:
    case RF1R:
        write_rfr(can, &can->fifos[(offset - RF0R) / 4], value);
        return true;
    case IER:
        can->ier = value;
        return value == 0 || refuse(can, "CAN1 interrupts were enabled, which are not modelled");
    case ESR:
        can->last_error = value >> 4 & 7u;
        return true;
    case BTR:
        return write_btr(can, value);
    default:
        return refuse(can, "CAN1 has no register at 0x%03X", (unsigned)offset);
    }
}
