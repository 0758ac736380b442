/* Acceptance filters and receive FIFOs of the bxCAN. */
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
