/* Acceptance filters, receive FIFOs and transmit mailboxes of the bxCAN. */
#include "host_sim/emulator/models/bxcan_parts.h"

#include <string.h>

enum {
    RFLM = 1 << 3, FULL = 1 << 3, FOVR = 1 << 4, RFOM = 1 << 5,
    FMR = 0x200, BANK_0 = 0x240, FM1R = 1, FS1R = 3, FFA1R = 5, FA1R = 7, FINIT = 1,
    SLOW_RELEASE_NS = 100000
};

static const uint32_t UNDEFINED_TIME = 0xABCD0000u;

static uint32_t word_32(const struct frame *frame)
{
    uint32_t remote = frame->id & FRAME_REMOTE ? 1u << 1 : 0;

    return frame->id & FRAME_EXTENDED ? (frame->id & 0x1FFFFFFFu) << 3 | 1u << 2 | remote
                                      : (frame->id & 0x7FFu) << 21 | remote;
}

static uint32_t word_16(const struct frame *frame)
{
    uint32_t remote = frame->id & FRAME_REMOTE ? 1u << 4 : 0;
    uint32_t id = frame->id & 0x1FFFFFFFu;

    return frame->id & FRAME_EXTENDED ? id >> 18 << 5 | remote | 1u << 3 | (id >> 15 & 7u)
                                      : (id & 0x7FFu) << 5 | remote;
}

static bool passes_32(const uint32_t bank[2], uint32_t word, bool list)
{
    return list ? word == bank[0] || word == bank[1] : ((word ^ bank[0]) & bank[1]) == 0;
}

static bool half_passes(uint32_t half, uint32_t word, bool list)
{
    uint32_t low = half & 0xFFFFu, high = half >> 16;

    return list ? word == low || word == high : ((word ^ low) & high) == 0;
}

int bxcan_fifo_for(const struct bxcan *can, const struct frame *frame)
{
    const uint32_t *words = can->filters.words;

    for (unsigned n = 0; n < can->bank_count && !(words[0] & FINIT); n++) {
        const uint32_t *bank = &can->filters.banks[2 * n];
        bool list = words[FM1R] >> n & 1u, wide = words[FS1R] >> n & 1u;
        bool passes = wide ? passes_32(bank, word_32(frame), list)
                           : half_passes(bank[0], word_16(frame), list) || half_passes(bank[1], word_16(frame), list);

        if (words[FA1R] >> n & 1u && passes)
            return (int)(words[FFA1R] >> n & 1u);
    }
    return -1;
}

bool bxcan_write_filters(struct bxcan *can, uint32_t offset, uint32_t value)
{
    static const char *const names[] = {"FMR", "FM1R", "", "FS1R", "", "FFA1R", "", "FA1R", ""};
    bool in_init = can->filters.words[0] & FINIT;
    uint32_t at = (offset - FMR) / 4, bank = (offset - BANK_0) / 8;

    if (offset >= BANK_0) {
        if (!in_init && can->filters.words[FA1R] >> bank & 1u)
            return node_refuse(&can->node, "CAN1 F%uR%u was written while its filter is active", (unsigned)bank,
                                offset / 4 % 2 + 1u);
        can->filters.banks[(offset - BANK_0) / 4] = value;
        return true;
    }
    if (!in_init && at != 0 && at != FA1R)
        return node_refuse(&can->node, "CAN1 %s was written outside the filters' set-up (FMR FINIT)", names[at]);
    can->filters.words[at] = value;
    return true;
}

/* With RFLM a full FIFO keeps its frames; otherwise the new frame overwrites the newest one. */
void bxcan_store(struct can_node *node, const struct frame *frame)
{
    struct bxcan *can = (struct bxcan *)node;
    int number = bxcan_fifo_for(can, frame);
    struct bxcan_fifo *fifo = &can->fifos[number > 0];

    if (number < 0)
        return;
    if (fifo->count == BXCAN_FIFO_DEPTH) {
        fifo->flags |= FOVR;
        node->overruns++;
        if (can->mcr & RFLM)
            return;
        fifo->count--;
    }
    fifo->frames[fifo->count++] = *frame;
    if (fifo->count == BXCAN_FIFO_DEPTH)
        fifo->flags |= FULL;
}

static void release(struct bxcan_fifo *fifo)
{
    fifo->flags &= ~(uint32_t)RFOM;
    memmove(&fifo->frames[0], &fifo->frames[1], --fifo->count * sizeof fifo->frames[0]);
}

void bxcan_release_due(struct can_node *node)
{
    struct bxcan *can = (struct bxcan *)node;

    for (unsigned n = 0; n < 2; n++)
        if (can->fifos[n].flags & RFOM && can->fifos[n].release_ns <= can->node.wire->now_ns)
            release(&can->fifos[n]);
}

void bxcan_write_rfr(const struct bxcan *can, struct bxcan_fifo *fifo, uint32_t value)
{
    fifo->flags &= ~(value & (FULL | FOVR));
    if (!(value & RFOM) || fifo->count == 0)
        return;
    if (can->release_slow) {
        fifo->flags |= RFOM;
        fifo->release_ns = can->node.wire->now_ns + SLOW_RELEASE_NS;
    } else {
        release(fifo);
    }
}

static uint32_t word_at(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* The output mailbox of a FIFO. The time stamp is undefined outside time-triggered mode. */
int64_t bxcan_read_output(struct bxcan *can, uint32_t at)
{
    const struct bxcan_fifo *fifo = &can->fifos[at / 16];
    const struct frame *frame = &fifo->frames[0];
    uint32_t remote = frame->id & FRAME_REMOTE ? BXCAN_RTR : 0;

    if (fifo->count == 0) {
        (void)node_refuse(&can->node, "the output mailbox of CAN1 FIFO %u was read, but the FIFO is empty",
                          (unsigned)at / 16);
        return -1;
    }
    switch (at / 4 % 4) {
    case 0:
        return (frame->id & FRAME_EXTENDED ? (frame->id & 0x1FFFFFFFu) << 3 | BXCAN_IDE : frame->id << 21) | remote;
    case 1:
        return UNDEFINED_TIME | frame->len;
    default:
        return word_at(&frame->data[at % 16 - 8]);
    }
}

/* ---- transmit mailboxes */

enum {
    TXFP = 1 << 2, NART = 1 << 4,
    RQCP = 1 << 0, TXOK = 1 << 1, ALST = 1 << 2, TERR = 1 << 3, ABRQ = 1 << 7
};

static void end(struct bxcan *can, unsigned n, uint32_t status)
{
    struct bxcan_mailbox *box = &can->mailboxes[n];

    box->pending = box->aborting = false;
    box->status = RQCP | status;
    box->words[0] &= ~(uint32_t)BXCAN_TXRQ;
}

static struct frame frame_in(const struct bxcan_mailbox *box)
{
    uint32_t id = box->words[0];
    struct frame frame = {.id = id & BXCAN_IDE ? FRAME_EXTENDED | id >> 3 : id >> 21};
    uint32_t len = box->words[1] & 15u;

    frame.len = (uint8_t)(len < 8 ? len : 8);
    if (id & BXCAN_RTR)
        frame.id |= FRAME_REMOTE;
    for (unsigned i = 0; i < 8 && i < len; i++)
        frame.data[i] = (uint8_t)(box->words[2 + i / 4] >> 8 * (i % 4));
    return frame;
}

/* Priority: with TXFP by time of request, otherwise by identifier and then by mailbox number. */
static bool goes_before(const struct bxcan *can, unsigned a, unsigned b)
{
    const struct bxcan_mailbox *boxes = can->mailboxes;
    uint32_t id_a = boxes[a].words[0], id_b = boxes[b].words[0];

    if (can->mcr & TXFP)
        return boxes[a].request < boxes[b].request;
    return id_a < id_b || (id_a == id_b && a < b);
}

/* The pending mailbox in `mask` that is sent first, or last; -1 if there is none. */
static int pick(const struct bxcan *can, unsigned mask, bool last)
{
    int picked = -1;

    for (unsigned n = 0; n < BXCAN_MAILBOXES; n++)
        if (can->mailboxes[n].pending && mask >> n & 1u
            && (picked < 0 || goes_before(can, n, (unsigned)picked) != last))
            picked = (int)n;
    return picked;
}

bool bxcan_offer(struct can_node *node, struct frame *out)
{
    struct bxcan *can = (struct bxcan *)node;

    node->on_wire = pick(can, ~node->stuck_mailboxes, false);
    if (node->on_wire < 0)
        return false;
    *out = frame_in(&can->mailboxes[node->on_wire]);
    return true;
}

void bxcan_end(struct can_node *node, enum node_outcome outcome)
{
    static const uint32_t status[] = {TXOK, ALST, TERR};
    struct bxcan *can = (struct bxcan *)node;
    int n = node->on_wire;

    node->on_wire = -1;
    if (n >= 0 && (outcome == NODE_SENT || can->mcr & NART || can->mailboxes[n].aborting))
        end(can, (unsigned)n, status[outcome]);
}

uint32_t bxcan_read_tsr(const struct bxcan *can)
{
    int last = pick(can, 7, true);
    uint32_t status = 0, pending = 0, free_box = BXCAN_MAILBOXES;

    for (unsigned n = BXCAN_MAILBOXES; n-- > 0;) {
        status |= can->mailboxes[n].status << 8 * n;
        pending |= can->mailboxes[n].pending ? 1u << n : 0u;
        free_box = can->mailboxes[n].pending ? free_box : n;
    }
    status |= (free_box < BXCAN_MAILBOXES ? free_box : (uint32_t)last) << 24 | (~pending & 7u) << 26;
    return pending & (pending - 1) ? status | 1u << (29 + last) : status;   /* LOW needs several pending */
}

/* Aborts a request at once, unless its frame is on the wire: that transmission is completed. */
void bxcan_write_tsr(struct bxcan *can, uint32_t value)
{
    for (unsigned n = 0; n < BXCAN_MAILBOXES; n++) {
        struct bxcan_mailbox *box = &can->mailboxes[n];
        uint32_t written = value >> 8 * n & 0xFFu;

        box->status &= written & RQCP ? 0u : ~written;
        if (!(written & ABRQ) || !box->pending)
            continue;
        box->aborting = true;
        if ((int)n != can->node.on_wire && !(can->node.stuck_mailboxes >> n & 1u))
            end(can, n, 0);
    }
}

bool bxcan_write_mailbox(struct bxcan *can, uint32_t at, uint32_t value)
{
    unsigned n = at / 16;
    struct bxcan_mailbox *box = &can->mailboxes[n];

    if (box->pending)
        return node_refuse(&can->node, "CAN1 transmit mailbox %u was written while its frame is pending", n);
    box->words[at / 4 % 4] = value;
    if (at % 16 == 0 && value & BXCAN_TXRQ) {
        box->pending = true;
        box->status = 0;
        box->request = can->requests++;
    }
    return true;
}
