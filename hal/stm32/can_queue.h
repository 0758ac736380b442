/* can_queue.h: frames on their way out, through the chip's own CAN controller.
 *
 * The controller sends the lowest identifier first, so that other nodes' frames hold a drive up no longer than its own priority
 * allows, whatever else the robot has to say. On an idle bus frames leave in the order in which they were put all the same: an
 * urgent one lets the others go first, as long as they do go. */
#ifndef OCTET_CAN_QUEUE_H
#define OCTET_CAN_QUEUE_H

#include <stdbool.h>

#include "hal/link/link.h"

enum { CAN_QUEUE_MAX = 8 };   /* with what the controller takes: all that a robot tells of itself at once */

struct can_queue {
    struct frame frames[CAN_QUEUE_MAX];   /* not urgent, and not yet in the controller */
    uint8_t first, count;
    uint8_t dropped;      /* as in struct link_health */
    unsigned waiting;     /* frames that had not left as of the last look */
    uint32_t moved_ms;    /* when one last did, or none was there */
    uint8_t stuck_ms;     /* on an idle bus a frame leaves in less, */
    uint8_t drain_ms;     /* and all that can wait in this; but link_send has promised to be back */
};

void can_queue_begin(struct can_queue *queue, uint32_t bitrate);
        /* Empties it, for a bus of that many bit/s. */

bool can_queue_put(struct can_queue *queue, const struct frame *frame);
        /* False, and counted: the bus takes nothing. One that is more urgent than all that waits overtakes them where they do
           not leave as fast as they would on an idle bus; if the controller is full, the least urgent frame there is dropped
           for it. What has waited for LINK_SEND_MS without any of it leaving is out of date, and dropped. */

unsigned can_queue_pump(struct can_queue *queue);
        /* Hands a frame on to the controller if one fits. Returns how many have not left. */

void can_queue_drop(struct can_queue *queue);
        /* Forgets and counts all that waits. */

#endif
