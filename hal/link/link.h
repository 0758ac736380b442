/* link.h: what carries single CAN frames. The CAN body stands on these functions and on nothing else. One thread uses a link.
 *
 * Chosen by linking on a microcontroller; on the host link_by_name.c chooses among them by the name's first part:
 * socketcan:IFACE, fd:N (a SOCK_SEQPACKET socket or a bound CAN one, which link_close closes), slcan:PATH[@BAUD]. */
#ifndef OCTET_LINK_H
#define OCTET_LINK_H

#include <stddef.h>
#include <stdint.h>

#define FRAME_EXTENDED 0x80000000u   /* in id: a 29-bit identifier */
#define FRAME_REMOTE 0x40000000u     /* in id: a remote request */
#define FRAME_ERROR 0x20000000u      /* in id: an error message of the bus */

enum {
    LINK_SEND_MS = 10,   /* a frame that the bus does not take within this time is given up */
    LINK_IDS_MAX = 8,    /* identifiers that a link can listen for */
    LINK_FAMILY_BITS = 0x1F,
    LINK_FAMILY = 0x8000 /* with an identifier: it and all that differ from it in these bits only, as one */
};

struct frame {
    uint32_t id;       /* 0..0x7FF for the frames we use; other kinds have a flag in the top bits, and callers ignore them */
    uint8_t len;       /* 0..8 */
    uint8_t data[8];   /* zero from len on */
};

enum link_error {
    LINK_E_NAME = -1,      /* the name makes no sense; said on stderr in one line */
    LINK_E_OPEN = -2,      /* it cannot be opened; said on stderr in one line, with the system's reason */
    LINK_E_CLOSED = -3,    /* the far side is gone for good; open again to go on */
    LINK_E_DOWN = -4,      /* the bus is down just now; waiting and calling again is right */
    LINK_E_GARBLED = -5,   /* something came that is not a frame; it is dropped */
    LINK_E_FULL = -6       /* the bus did not take the frame within LINK_SEND_MS; it is dropped */
};

enum bus_state { BUS_ACTIVE, BUS_PASSIVE, BUS_OFF };   /* CAN's error active, error passive, bus-off */

struct link_health {
    enum bus_state state;
    uint8_t tx_errors;   /* CAN's transmit and receive error counters */
    uint8_t rx_errors;
    uint8_t bus_offs;    /* times that the bus was lost, stays at 255 */
    uint8_t dropped;     /* frames that link_send took and the bus did not, stays at 255 */
};

struct link;   /* one open link */

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count);
        /* 0, or LINK_E_NAME or LINK_E_OPEN with *link untouched. ids: the identifiers to listen for, or whole families of
           them with LINK_FAMILY; a link that can filter lets no others through, one that cannot delivers all. Where a
           family comes faster than it is received, it does not push out what else comes. At most LINK_IDS_MAX. */

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms);
        /* 1: *out filled. 0: nothing for wait_ms; 0 polls. Or LINK_E_GARBLED at once for anything that is not a frame,
           LINK_E_DOWN after wait_ms, LINK_E_CLOSED at once. Signals do not cut the wait short. */

int link_send(struct link *link, const struct frame *frame);
        /* 0: the bus has it. Or LINK_E_FULL, LINK_E_DOWN, LINK_E_CLOSED. Waits LINK_SEND_MS at the most. */

void link_health(const struct link *link, struct link_health *out);
        /* The state of the bus. All zero, an active bus without errors, from a link that cannot know. */

void link_close(struct link *link);
        /* Frees it. A null link is fine. */

#endif
