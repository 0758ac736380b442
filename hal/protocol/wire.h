/* wire.h: frames to inputs and outputs to frames, as octet.dbc has them. Whatever a bus may bring is checked here,
 * once: what gets past is valid. */
#ifndef OCTET_WIRE_H
#define OCTET_WIRE_H

#include "firmware/io.h"
#include "hal/protocol/health.h"

enum {
    WIRE_LISTEN_COUNT = 2,   /* identifiers that the robot listens for */
    WIRE_FRAMES_MAX = 7      /* that one output makes */
};

enum fault {
    FAULT_SILENCE,   /* no senses came for the silence limit */
    FAULT_MISSED,    /* a tick's senses never came */
    FAULT_STALE,     /* came twice, or too late */
    FAULT_DAMAGED,   /* wrong CRC or length, or no frame at all */
    FAULT_FOREIGN,   /* not for this node */
    FAULT_UNSENT,    /* the bus did not take it in time */
    FAULT_REFUSED,   /* a command that was understood and refused */
    FAULT_UNSAVED,   /* the memory could not be stored, or was none */
    FAULT_COUNT
};

struct wire {
    uint8_t node;                 /* 1..63 */
    uint8_t faults[FAULT_COUNT];  /* each stays at 255 */
    uint16_t tick;                /* of the last senses taken */
    uint8_t counter;              /* of the last command taken, */
    uint8_t opcode;               /* and what it was: both go into its answer */
    bool knows_tick;              /* false: whatever tick comes next is taken */
    bool knows_counter;
    bool lockstep;                /* the sender's clock rules */
    struct health health;         /* to be reported; whoever knows it keeps it up to date */
    uint8_t crash_value;          /* place of the one to be told next */
};

void wire_init(struct wire *wire, uint8_t node);
        /* node is 1..NODE_MAX. */

void wire_ids(const struct wire *wire, uint16_t ids[WIRE_LISTEN_COUNT]);
        /* The identifiers to listen for. */

enum input_kind wire_read(struct wire *wire, const struct frame *frame, struct input *in);
        /* INPUT_SENSES or INPUT_COMMAND: fresh, whole and for us, and that part of *in is filled. INPUT_SILENCE: none of
           that; it is counted, and *in is untouched. */

size_t wire_write(struct wire *wire, const struct output *out, struct frame frames[WIRE_FRAMES_MAX]);
        /* Returns how many frames the marked parts make, 0..WIRE_FRAMES_MAX; the drive is last. */

void wire_outage(struct wire *wire);
        /* The senses have failed to come: counted if they had been coming, and the next tick need not follow the
           last. */

uint32_t wire_id(const struct wire *wire, uint32_t id_of_node_1);
        /* octet.dbc has the identifiers of node 1: the same for this node. */

void wire_count(struct wire *wire, enum fault fault);
        /* One more of these. */

#endif
