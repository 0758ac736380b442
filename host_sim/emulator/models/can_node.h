/* can_node.h: what CAN controllers have in common, after ISO 11898-1: joining and leaving a bus, error counters, and
 * bus-off. Accesses that a manual forbids or that are not modelled are refused with a reason. Python reads this
 * header too. */
#ifndef OCTET_CAN_NODE_H
#define OCTET_CAN_NODE_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/emulator/models/can_wire.h"

enum { NODE_REFUSAL_MAX = 96, NODE_PASSIVE = 128 /* from this error count on */, NODE_WARNING = 96 };

enum node_mode { NODE_NORMAL = 0, NODE_INIT = 1, NODE_SLEEP = 2 };

enum node_error { NODE_NO_ACKNOWLEDGE = 3, NODE_BIT_DOMINANT = 5 };   /* as the last error codes of all have it */

enum node_outcome { NODE_SENT, NODE_LOST_ARBITRATION, NODE_DESTROYED };

struct can_node;

/* What each kind of controller implements. */
struct can_kind {
    int64_t (*read)(struct can_node *node, uint32_t offset);    /* what a register holds, or -1: refused */
    bool (*write)(struct can_node *node, uint32_t offset, uint32_t value);   /* false: refused */
    bool (*offer)(struct can_node *node, struct frame *out);    /* the frame to send next; sets on_wire */
    void (*end)(struct can_node *node, enum node_outcome outcome);   /* of on_wire, which is set to -1 */
    void (*store)(struct can_node *node, const struct frame *frame);  /* one that has arrived whole */
    void (*lose_bus)(struct can_node *node);                    /* it has just gone bus-off */
    void (*pass)(struct can_node *node);                        /* time has passed */
    uint32_t (*bit_rate)(const struct can_node *node);          /* as it was set up, bit/s */
};

struct can_node {
    const struct can_kind *kind;
    uint32_t clock_hz;         /* that the bit timing divides */
    bool clocked;              /* whether it has a clock at all: without one no register can be reached */
    bool init_stuck;           /* faults: init is never entered; */
    bool recovery_stuck;       /* bus-off never ends; */
    unsigned stuck_mailboxes;  /* bit n: mailbox n neither sends nor gives up */
    char refusal[NODE_REFUSAL_MAX];   /* why an access was refused; empty: none was */

    struct can_wire *wire;
    enum node_mode mode, wanted;
    unsigned inits;            /* times that init was entered */
    uint64_t mode_ns;          /* when the wanted mode is entered */
    uint64_t recovery_ns;      /* when bus-off is over */
    unsigned tec, rec;         /* error counters */
    unsigned last_error;
    bool bus_off;
    int on_wire;               /* mailbox whose frame the wire carries, or -1 */
    unsigned overruns;         /* frames lost in full FIFOs so far */
};

void node_open(struct can_node *node, const struct can_kind *kind, struct can_wire *wire);
        /* Attaches it to a wire. Reset it next. */

void node_reset(struct can_node *node, enum node_mode mode);
        /* Without errors, in that mode. */

int64_t node_read(struct can_node *node, uint32_t offset);
        /* What a register holds, or -1: refused. */

bool node_write(struct can_node *node, uint32_t offset, uint32_t value);
        /* Writes a register; false: refused. The effects come as time passes on the wire. */

bool node_refuse(struct can_node *node, const char *format, ...);
        /* Always false. */

void node_ask_mode(struct can_node *node, enum node_mode wanted);
        /* Begins to wait for that mode. */

void node_recover(struct can_node *node);
        /* Begins to wait for the end of bus-off. */

bool node_is_passive(const struct can_node *node);

/* What the wire asks of a controller. */
bool node_listens(const struct can_node *node);
bool node_offer(struct can_node *node, struct frame *out);
void node_lost_arbitration(struct can_node *node);
void node_sent(struct can_node *node);
void node_failed(struct can_node *node, enum node_error error);
void node_arrived(struct can_node *node, const struct frame *frame, bool destroyed);

uint64_t node_advance(struct can_node *node);
        /* Enters a mode, or ends bus-off, if due. Returns when the next one is due, or UINT64_MAX for never. */

#endif
