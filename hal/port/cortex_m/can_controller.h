/* can_controller.h: a chip's own CAN controller, as the link over it needs it. Exactly one implementation is linked
 * in. It is polled: no interrupt is used, and nothing but can_stop waits. */
#ifndef OCTET_CAN_CONTROLLER_H
#define OCTET_CAN_CONTROLLER_H

#include <stdbool.h>

#include "hal/link/link.h"

enum {
    CAN_STOP_MS = 2,   /* the frame under way ends first */
    CAN_BUFFERS = 3,   /* for frames to be sent */
    CAN_FIFOS = 2,     /* of received frames; the last one is for families, which displace no others there */
    CAN_QUANTA_AFTER = 2,   /* after the sample point, which is thus at 75..89 % of the bit */
    CAN_QUANTA_JUMP = 2     /* resynchronization jump width */
};

bool can_stop(void);
        /* Leaves the bus and enters configuration mode. False: no answer within CAN_STOP_MS. */

void can_set_up(uint32_t prescaler, uint32_t quanta, const uint16_t ids[], size_t id_count);
        /* Sets the bit timing and the identifiers to listen for (link_open): data frames only. A bit is 8..18 quanta:
           periods of the controller's clock divided by the prescaler. */

void can_start(void);
        /* Joins the bus once idle for 11 bits, without waiting for it; after bus-off, 128 times as long. */

enum can_state { CAN_JOINING, CAN_JOINED, CAN_LOST };

enum can_state can_state(void);
        /* CAN_LOST: bus-off, until can_stop and can_start have taken effect. */

int can_take(unsigned fifo, struct frame *out);
        /* Takes the oldest frame of a FIFO. Returns 1, 0 for none, or LINK_E_GARBLED if frames were lost. */

bool can_put(const struct frame *frame);
        /* Queues a frame: the lowest identifier is sent first, and equal ones in the order of these calls. False: no
           free buffer could keep that order. */

uint32_t can_waiting(void);
        /* Bit n: buffer n holds a frame that waits or is being sent. */

uint32_t can_waiting_id(unsigned n);
        /* The identifier of the frame in buffer n; that of an earlier one, or any, if it holds none. */

void can_abort(uint32_t buffers);
        /* Cancels the frames in these buffers, one bit each. A frame that is being sent may still arrive, and keeps
           its buffer until then. */

void can_status(struct link_health *out);
        /* Fills in state, tx_errors and rx_errors. */

#endif
