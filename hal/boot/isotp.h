/* isotp.h: ISO-TP (ISO 15765-2) on classic CAN: one connection, one message at a time each way, normal addressing. Who uses it
 * gives it the time and the frames, and sends what it has to say; nothing here waits. */
#ifndef OCTET_ISOTP_H
#define OCTET_ISOTP_H

#include <stdbool.h>

#include "hal/link/link.h"

enum {
    ISOTP_RX_MAX = 1026,      /* bytes of a message: a block of 1024 with its service and its number */
    ISOTP_TX_MAX = 72,
    ISOTP_TIMEOUT_MS = 1000   /* N_Cr and N_Bs: after that, a message that does not go on is forgotten */
};

struct isotp {
    uint16_t id;                  /* of the frames that are sent */
    uint16_t rx_len, rx_at;       /* bytes announced; bytes there: rx_at < rx_len: a message is on its way */
    uint8_t rx_number;            /* of the consecutive frame that comes next, 0..15 */
    uint8_t flow;                 /* a flow control to be sent: its first byte, or 0 */
    uint16_t tx_len, tx_at;       /* tx_at < tx_len: on its way */
    uint8_t tx_number;
    uint8_t block;                /* frames until the next flow control; 0: none is needed */
    uint8_t gap_ms;               /* between two consecutive frames */
    bool waiting;                 /* for a flow control */
    uint32_t rx_ms, tx_ms;        /* when there was progress */
    uint8_t rx[ISOTP_RX_MAX + 7];   /* a frame more, so that no length has to be trusted */
    uint8_t tx[ISOTP_TX_MAX + 7];
};

uint16_t isotp_take(struct isotp *isotp, const struct frame *frame, uint32_t now_ms);
        /* A frame of the connection has come. The length of the message that it completes, in rx until the next call; else 0.
           Frames that do not fit are left out, and what they interrupt is forgotten, as the standard has it. */

bool isotp_receives(struct isotp *isotp, uint32_t now_ms);
        /* A message is on its way here: the first rx_at bytes are in rx. */

void isotp_send(struct isotp *isotp, uint16_t len);
        /* Begins to send the first bytes of tx, 1..ISOTP_TX_MAX; what was on its way is given up. */

bool isotp_next(struct isotp *isotp, struct frame *out, uint32_t now_ms);
        /* The frame that is to be sent now, if any. */

void isotp_sent(struct isotp *isotp, uint32_t now_ms);
        /* The frame of isotp_next has gone. */

bool isotp_busy(const struct isotp *isotp);
        /* Something waits to be sent. */

#endif
