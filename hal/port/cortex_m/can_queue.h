/* can_queue.h: the transmit queue of the chip's own CAN controller.
 *
 * The controller sends the lowest identifier first, so that other nodes' frames delay a drive no longer than its
 * priority allows, whatever else the robot sends. Yet on an idle bus frames leave in the order of the calls: an
 * urgent one lets the others go first, as long as they do go. */
#ifndef OCTET_CAN_QUEUE_H
#define OCTET_CAN_QUEUE_H

#include <stdbool.h>

#include "hal/link/link.h"

enum { CAN_QUEUE_MAX = 8 };   /* with the controller's buffers, room for the robot's longest report */

struct can_queue {
    struct frame frames[CAN_QUEUE_MAX];   /* not urgent, and not yet in the controller */
    uint8_t first, count;
    uint8_t dropped;      /* as in struct link_health */
    unsigned waiting;     /* frames not yet sent, as of the last check */
    uint32_t moved_ms;    /* when one was last sent, or none was waiting */
    uint8_t stuck_ms;     /* on an idle bus, a frame is sent in less, */
    uint8_t drain_ms;     /* and a full queue in this, within the limit of link_send */
};

void can_queue_begin(struct can_queue *queue, uint32_t bitrate);
        /* Empties it, for a bus of that many bit/s. */

bool can_queue_put(struct can_queue *queue, const struct frame *frame);
        /* Queues a frame. False, and counted: the bus takes nothing. A frame more urgent than all that wait overtakes
           them if they leave more slowly than on an idle bus; if the controller is full, its least urgent frame is
           dropped. Frames that waited for LINK_SEND_MS without any of them leaving are out of date and dropped. */

unsigned can_queue_pump(struct can_queue *queue);
        /* Moves a frame to the controller if it fits. Returns how many frames are not yet sent. */

void can_queue_drop(struct can_queue *queue);
        /* Drops and counts all waiting frames. */

#endif
