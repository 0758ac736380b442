/* wire.h: converts frames to inputs and outputs to frames, as octet.dbc defines them. Everything from the bus is
 * checked here, once: inputs are valid. */
#ifndef OCTET_WIRE_H
#define OCTET_WIRE_H

#include "hal/link/link.h"
#include "hal/protocol/health.h"
#include "hal/protocol/session.h"

enum {
    WIRE_LISTEN_COUNT = 6,   /* identifiers that the robot listens for, and one family */
    WIRE_FRAMES_MAX = 11     /* that one output makes */
};

/* The messages with an alive counter of their own. */
enum counted { COUNTED_EMERGENCY, COUNTED_MEMORY, COUNTED_HEARTBEAT, COUNTED_BOOT, COUNTED_FAULTS, COUNTED_CRASH,
               COUNTED_HEALTH, COUNTED_KINDS };

struct wire {
    uint8_t node;                    /* 1..NODE_MAX */
    uint8_t faults[FAULT_COUNT];     /* each stays at 255 */
    uint16_t news;                   /* kinds of faults that no EMERGENCY has reported yet, bit i for kind i, */
    uint8_t first_news;              /* and the first of them */
    struct session session;
    uint8_t senses_crc;              /* of the last senses accepted, */
    uint8_t other_crc;               /* and of the last different senses for that tick; the same if none */
    bool noisy;                      /* a frame was damaged since the last heartbeat */
    uint8_t counters[COUNTED_KINDS]; /* of the next message of each kind */
    uint8_t part;                    /* of the current report: the part to send next; 0 for none */
    bool wants_ranges;               /* the behaviour asks for RANGES */
    bool has_ranges;                 /* they have come: */
    uint8_t ranges_tick;
    uint8_t range_mm[FEEL_COUNT];
    uint32_t told_lower, told_upper; /* bit n - 1: node n has sent this half of its memory since the last report */
    uint8_t strangers;               /* frames with our own identifiers since the last heartbeat: one may be noise */
    bool twin;                       /* another robot with this number was heard since the last start */
    bool unasked;                    /* the command in hand is the wire's own or a button's, and has no answer */
    struct frame drive, answer;      /* as last sent, for repetition on request */
    struct frame refusal;
    const struct frame *again;       /* the frame to repeat after wire_read; null for none */
    struct health health;            /* to be reported; the body keeps it up to date */
    uint8_t crash_value;             /* index of the value to report next */
};

void wire_init(struct wire *wire, uint8_t node);
        /* As after power-up: no session, nothing counted. node is 1..NODE_MAX. */

void wire_ids(const struct wire *wire, uint16_t ids[WIRE_LISTEN_COUNT]);
        /* The identifiers to listen for, as link_open takes them. The robot's own are among them: another node that
           sends those has the same number. */

void wire_boot(struct wire *wire, struct frame *frame);
        /* Writes the BOOT message. */

enum input_kind wire_read(struct wire *wire, const struct frame *frame, struct input *in);
        /* Reads a frame. INPUT_SENSES, INPUT_COMMAND or INPUT_PEER, as in hal_receive: it is fresh, valid and for us;
           that part of *in is filled. INPUT_SILENCE: none of these; *in is untouched. The frame was counted, or is
           a repetition, and wire->again is the answer to repeat. A frame from a twin becomes a command to stop. */

size_t wire_write(struct wire *wire, const struct output *out, struct frame frames[WIRE_FRAMES_MAX]);
        /* Returns how many frames the marked parts make, 0..WIRE_FRAMES_MAX; the drive is last. A report is spread
           over this output and those after it, one part each, unless it is marked whole; a new memory goes first. */

void wire_senses(struct wire *wire, const struct senses *senses, struct frame *frame);
        /* Writes the senses of the robot's own body, for listeners. The drive that is written next answers them. */

void wire_outage(struct wire *wire);
        /* Handles silence: counts it if senses had been arriving; any tick may come next, and the owner has lost the
           robot. In lockstep only the latter. */

uint32_t wire_id(const struct wire *wire, uint32_t id_of_node_1);
        /* Converts an identifier of node 1, as in octet.dbc, to this node's. */

void wire_count(struct wire *wire, enum fault fault);
        /* Counts a fault of this kind. */

/* The frames of one output, as they are being built. */

struct frames {
    struct frame *first;
    size_t count;
};

struct frame *frames_add(struct frames *frames, const struct wire *wire, uint32_t id_of_node_1, uint8_t len);
        /* Appends a frame of zeros. The identifier is that of node 1 in octet.dbc; it becomes that of this node. */

uint8_t frames_count_up(struct wire *wire, enum counted kind);
        /* Returns the alive counter for a message of this kind, and advances it. */

/* The messages that report the robot's state. */

void wire_report_start(struct wire *wire);
        /* Begins a run and its first second: no report is in progress, and no other robot has sent its memory yet. */

void wire_report(struct wire *wire, const struct output *out, struct frames *frames);
        /* Writes what is due of the report: all of it if it is marked whole, else one part an output, from the output
           that brings it on. A new memory is told at once, and holds up the next part by one output. */

#endif
