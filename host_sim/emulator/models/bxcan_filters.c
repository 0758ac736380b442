/* Acceptance filters of the bxCAN. */
#include "host_sim/emulator/models/bxcan_model.h"

enum { FM1R = 1, FS1R = 3, FFA1R = 5, FA1R = 7, FINIT = 1 };

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
