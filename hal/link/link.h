/* link.h: sends and receives single CAN frames. The CAN body uses nothing else. One thread uses a link.
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
    LINK_SEND_MS = 10,   /* timeout of a send; then the frame is dropped */
    LINK_IDS_MAX = 8,    /* maximum number of identifiers to listen for */
    LINK_FAMILY_BITS = 0x1F,
    LINK_FAMILY = 0x8000 /* flag: all identifiers that differ in the LINK_FAMILY_BITS only count as one */
};

struct frame {
    uint32_t id;       /* 0..0x7FF for frames we use; others have a flag in the top bits, and callers ignore them */
    uint8_t len;       /* 0..8 */
    uint8_t data[8];   /* zero from len on */
};

enum link_error {
    LINK_E_NAME = -1,      /* invalid name; reported on stderr in one line */
    LINK_E_OPEN = -2,      /* cannot be opened; reported on stderr in one line, with the system's reason */
    LINK_E_CLOSED = -3,    /* the far side is gone for good; reopen to continue */
    LINK_E_DOWN = -4,      /* the bus is down at the moment; wait and retry */
    LINK_E_GARBLED = -5,   /* received something that is not a frame; dropped */
    LINK_E_FULL = -6       /* the bus did not accept the frame within LINK_SEND_MS; dropped */
};

enum bus_state { BUS_ACTIVE, BUS_PASSIVE, BUS_OFF };   /* CAN's error active, error passive, bus-off */

struct link_health {
    enum bus_state state;
    uint8_t tx_errors;   /* CAN's transmit and receive error counters */
    uint8_t rx_errors;
    uint8_t bus_offs;    /* number of bus-offs, saturates at 255 */
    uint8_t dropped;     /* frames that link_send accepted and the bus did not, saturates at 255 */
};

struct link;   /* one open link */

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count);
        /* Returns 0, or LINK_E_NAME or LINK_E_OPEN with *link untouched. ids: the identifiers to listen for, at most
           LINK_IDS_MAX; with LINK_FAMILY, a whole family each. A link that can filter drops all others, one that
           cannot delivers them. A family that arrives faster than it is read does not displace other frames. */

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms);
        /* Returns 1 with *out filled, or 0 after wait_ms without a frame; 0 ms polls. Or LINK_E_GARBLED or
           LINK_E_CLOSED at once, LINK_E_DOWN after wait_ms. Signals do not shorten the wait. */

int link_send(struct link *link, const struct frame *frame);
        /* 0: the bus accepted the frame. Else LINK_E_FULL, LINK_E_DOWN or LINK_E_CLOSED. Waits up to LINK_SEND_MS. */

void link_health(const struct link *link, struct link_health *out);
        /* The state of the bus. A link that cannot know reports all zeros: an active bus without errors. */

void link_close(struct link *link);
        /* Closes and frees it; null is allowed. */

#endif
