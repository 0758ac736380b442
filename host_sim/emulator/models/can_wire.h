/* can_wire.h: a CAN bus at 500 kbit/s: who may send, who acknowledges, and how long a frame takes, without stuff
 * bits. On it are controllers, and one more node that stands for the rest of the world. Python reads this header,
 * too. */
#ifndef OCTET_CAN_WIRE_H
#define OCTET_CAN_WIRE_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/link/link.h"

enum {
    WIRE_BITRATE = 500000,
    WIRE_BIT_NS = 2000,
    WIRE_NODES_MAX = 4,
    WIRE_QUEUE_MAX = 1024
};

struct can_node;

struct frame_queue {
    struct frame frames[WIRE_QUEUE_MAX];
    unsigned first;
    unsigned count;
};

struct can_wire {
    bool alone;                  /* the rest of the world is not there: it neither acknowledges nor receives */
    bool shorted;                /* frames of controllers are destroyed, and the world does not send */
    bool busy;                   /* never idle: nothing new is sent, and no controller can join */
    uint64_t now_ns;
    uint64_t ends_ns;            /* when the frame on the wire is over */
    int sender;                  /* of that frame: a controller's number, or one of enum wire_sender */
    unsigned node_count;
    struct can_node *nodes[WIRE_NODES_MAX];
    struct frame passing;        /* on the wire */
    struct frame_queue waiting;  /* what the world wants to send */
    struct frame_queue heard;    /* what the world has received: wire_fetch takes it */
};

enum wire_sender { WIRE_IDLE = -1, WIRE_WORLD = -2 };

void wire_open(struct can_wire *wire);
        /* Initializes an idle bus without controllers, at time 0. */

bool wire_put(struct can_wire *wire, const struct frame *frame);
        /* Queues a frame from the world, which is sent once a controller listens. False: the queue is full. */

bool wire_fetch(struct can_wire *wire, struct frame *out);
        /* Takes the oldest frame that the world has received. False: there is none. */

uint64_t wire_advance(struct can_wire *wire, uint64_t now_ns);
        /* Runs what is due by now, on the wire and in its controllers. Returns when something is next due,
           UINT64_MAX for never: call again at that time, or it happens late. */

#endif
