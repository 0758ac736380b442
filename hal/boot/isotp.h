/* isotp.h: ISO-TP (ISO 15765-2) on classic CAN: one connection, one message at a time each way, normal addressing.
 * The caller provides the time and the received frames, and sends the frames; nothing here waits. */
#ifndef OCTET_ISOTP_H
#define OCTET_ISOTP_H

#include <stdbool.h>

#include "hal/link/link.h"

enum {
    ISOTP_RX_MAX = 1026,      /* bytes of a message: a block of 1024 with its service and block number */
    ISOTP_TX_MAX = 72,
    ISOTP_TIMEOUT_MS = 1000   /* N_Cr and N_Bs: a message without progress is dropped after this */
};

struct isotp {
    uint16_t id;                  /* of the frames that are sent */
    uint16_t rx_len, rx_at;       /* bytes announced and received; rx_at < rx_len: a message is in progress */
    uint8_t rx_number;            /* of the consecutive frame that comes next, 0..15 */
    uint8_t flow;                 /* first byte of a flow control to send, or 0 */
    uint16_t tx_len, tx_at;       /* tx_at < tx_len: in progress */
    uint8_t tx_number;
    uint8_t block;                /* frames until the next flow control; 0: none is needed */
    uint8_t gap_ms;               /* minimum time between two consecutive frames */
    bool waiting;                 /* for a flow control */
    uint32_t rx_ms, tx_ms;        /* time of the last progress */
    uint8_t rx[ISOTP_RX_MAX + 7];   /* room for one more frame, so that no length has to be trusted */
    uint8_t tx[ISOTP_TX_MAX + 7];
};

uint16_t isotp_take(struct isotp *isotp, const struct frame *frame, uint32_t now_ms);
        /* Handles a received frame. Returns the length of the message that it completes, in rx until the next call,
           or 0. Unexpected frames are ignored, or abort the message in progress, as the standard says. */

bool isotp_receives(struct isotp *isotp, uint32_t now_ms);
        /* Whether a message is being received: its first rx_at bytes are in rx. */

void isotp_send(struct isotp *isotp, uint16_t len);
        /* Begins to send len bytes of tx, 1..ISOTP_TX_MAX; aborts a message in progress. */

bool isotp_next(struct isotp *isotp, struct frame *out, uint32_t now_ms);
        /* The frame to send now, if any. */

void isotp_sent(struct isotp *isotp, uint32_t now_ms);
        /* The frame of isotp_next was sent. */

bool isotp_busy(const struct isotp *isotp);
        /* Whether there is something to send. */

#endif
