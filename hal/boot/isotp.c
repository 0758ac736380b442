#include "hal/boot/isotp.h"

#include <string.h>

enum {
    SINGLE = 0x00, FIRST = 0x10, CONSECUTIVE = 0x20, FLOW = 0x30,
    KIND = 0xF0, LOW = 0x0F,
    CONTINUE = 0, WAIT = 1, OVERFLOW = 2,    /* flow control */
    FRAME_BYTES = 8,
    SINGLE_MAX = 7, FIRST_BYTES = 6, NEXT_BYTES = 7,
    GAP_MS_MAX = 0x7F, GAP_US_FIRST = 0xF1, GAP_US_LAST = 0xF9,
    PADDING = 0xCC
};

static uint16_t smaller(unsigned a, unsigned b)
{
    return (uint16_t)(a < b ? a : b);
}

static uint16_t take_single(struct isotp *isotp, const struct frame *frame)
{
    uint16_t len = frame->data[0] & LOW;

    if (len == 0 || len > SINGLE_MAX || len >= frame->len)
        return 0;
    isotp->rx_len = 0;
    memcpy(isotp->rx, &frame->data[1], len);
    return len;
}

static void take_first(struct isotp *isotp, const struct frame *frame, uint32_t now_ms)
{
    unsigned len = (unsigned)(frame->data[0] & LOW) << 8 | frame->data[1];

    if (frame->len < FRAME_BYTES || len <= SINGLE_MAX)
        return;
    isotp->flow = len <= ISOTP_RX_MAX ? FLOW | CONTINUE : FLOW | OVERFLOW;
    isotp->rx_len = len <= ISOTP_RX_MAX ? (uint16_t)len : 0;
    isotp->rx_at = FIRST_BYTES;
    isotp->rx_number = 1;
    isotp->rx_ms = now_ms;
    memcpy(isotp->rx, &frame->data[2], FIRST_BYTES);
}

bool isotp_receives(struct isotp *isotp, uint32_t now_ms)
{
    if (isotp->rx_at >= isotp->rx_len)
        return false;
    if (now_ms - isotp->rx_ms > ISOTP_TIMEOUT_MS)
        isotp->rx_len = 0;
    return isotp->rx_len > 0;
}

static uint16_t take_consecutive(struct isotp *isotp, const struct frame *frame, uint32_t now_ms)
{
    uint16_t count = smaller(isotp->rx_len - isotp->rx_at, NEXT_BYTES);

    if (!isotp_receives(isotp, now_ms))
        return 0;
    if ((frame->data[0] & LOW) != isotp->rx_number || frame->len <= count) {
        isotp->rx_len = 0;
        return 0;
    }
    memcpy(&isotp->rx[isotp->rx_at], &frame->data[1], count);
    isotp->rx_at = (uint16_t)(isotp->rx_at + count);
    isotp->rx_number = (isotp->rx_number + 1) & LOW;
    isotp->rx_ms = now_ms;
    return isotp->rx_at < isotp->rx_len ? 0 : isotp->rx_len;
}

/* Gaps under a millisecond count as one; codes that the standard reserves count as the longest. */
static uint8_t gap_of(uint8_t code)
{
    if (code <= GAP_MS_MAX)
        return code;
    return code >= GAP_US_FIRST && code <= GAP_US_LAST ? 1 : GAP_MS_MAX;
}

static void take_flow(struct isotp *isotp, const struct frame *frame, uint32_t now_ms)
{
    unsigned status = frame->data[0] & LOW;

    if (frame->len < 3 || !isotp->waiting)
        return;
    isotp->tx_ms = now_ms;
    if (status == WAIT)
        return;
    isotp->waiting = false;
    isotp->block = frame->data[1];
    isotp->gap_ms = gap_of(frame->data[2]);
    if (status != CONTINUE)
        isotp->tx_at = isotp->tx_len;
}

uint16_t isotp_take(struct isotp *isotp, const struct frame *frame, uint32_t now_ms)
{
    if (frame->len < 2)
        return 0;
    switch (frame->data[0] & KIND) {
    case SINGLE: return take_single(isotp, frame);
    case FIRST: take_first(isotp, frame, now_ms); return 0;
    case CONSECUTIVE: return take_consecutive(isotp, frame, now_ms);
    case FLOW: take_flow(isotp, frame, now_ms); return 0;
    default: return 0;
    }
}

void isotp_send(struct isotp *isotp, uint16_t len)
{
    isotp->tx_len = smaller(len, ISOTP_TX_MAX);
    isotp->tx_at = 0;
    isotp->tx_number = 1;
    isotp->gap_ms = 0;
    isotp->waiting = false;
}

bool isotp_busy(const struct isotp *isotp)
{
    return isotp->flow != 0 || isotp->tx_at < isotp->tx_len;
}

static bool is_due(struct isotp *isotp, uint32_t now_ms)
{
    if (isotp->tx_at >= isotp->tx_len)
        return false;
    if (isotp->waiting) {
        if (now_ms - isotp->tx_ms > ISOTP_TIMEOUT_MS)
            isotp->tx_at = isotp->tx_len;
        return false;
    }
    return isotp->tx_at == 0 || now_ms - isotp->tx_ms >= isotp->gap_ms;
}

static bool begins(const struct isotp *isotp)
{
    return isotp->tx_at == 0 && isotp->tx_len > SINGLE_MAX;
}

/* Number of message bytes in the next frame, after its protocol bytes. */
static uint16_t portion(const struct isotp *isotp)
{
    return begins(isotp) ? (uint16_t)FIRST_BYTES : smaller(isotp->tx_len - isotp->tx_at, NEXT_BYTES);
}

static void fill(const struct isotp *isotp, uint8_t data[FRAME_BYTES])
{
    unsigned at = 0;

    if (begins(isotp)) {
        data[at++] = (uint8_t)(FIRST | isotp->tx_len >> 8);
        data[at++] = (uint8_t)isotp->tx_len;
    } else {
        data[at++] = isotp->tx_at > 0 ? (uint8_t)(CONSECUTIVE | isotp->tx_number) : (uint8_t)isotp->tx_len;
    }
    memcpy(&data[at], &isotp->tx[isotp->tx_at], portion(isotp));
}

bool isotp_next(struct isotp *isotp, struct frame *out, uint32_t now_ms)
{
    struct frame frame = {.id = isotp->id, .len = FRAME_BYTES};

    memset(frame.data, PADDING, sizeof frame.data);
    if (isotp->flow != 0) {
        frame.data[0] = isotp->flow;
        frame.data[1] = frame.data[2] = 0;   /* all frames in one block, without gaps */
    } else if (is_due(isotp, now_ms)) {
        fill(isotp, frame.data);
    } else {
        return false;
    }
    *out = frame;
    return true;
}

void isotp_sent(struct isotp *isotp, uint32_t now_ms)
{
    bool first = isotp->tx_at == 0;

    if (isotp->flow != 0) {
        isotp->flow = 0;
        return;
    }
    isotp->tx_at = (uint16_t)(isotp->tx_at + portion(isotp));
    isotp->tx_ms = now_ms;
    if (first) {
        isotp->waiting = isotp->tx_at < isotp->tx_len;
        return;
    }
    isotp->tx_number = (isotp->tx_number + 1) & LOW;
    if (isotp->block > 0) {
        isotp->block--;
        if (isotp->block == 0)
            isotp->waiting = isotp->tx_at < isotp->tx_len;
    }
}
