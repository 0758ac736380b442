/* can_controller_fake.h: a CAN controller that takes and sends as it is told, behind can_controller.h. Time passes whenever the
 * driver looks at the clock. */
#ifndef OCTET_CAN_CONTROLLER_FAKE_H
#define OCTET_CAN_CONTROLLER_FAKE_H

#include "hal/port/cortex_m/can_controller.h"

enum { FAKE_SENT_MAX = 300, LOOK_US = 50 };

struct can_fake {
    uint32_t now_us;
    uint32_t frame_us;        /* that the next frame needs to leave; 0: it never does */
    uint32_t since_us;        /* when the one under way began */
    bool refuses;             /* takes no frame, though a buffer is free */
    bool keeps;               /* gives nothing up */
    uint32_t waiting;         /* bit n: buffer n is taken */
    struct frame buffers[CAN_BUFFERS];
    unsigned order[CAN_BUFFERS];   /* which frame it was, of all that were taken */
    unsigned taken;
    uint32_t ids_elsewhere;   /* what can_waiting_id has for buffers that are free */
    struct frame sent[FAKE_SENT_MAX];
    unsigned sent_count;
    uint32_t aborted;         /* buffers that were last given up */
};

extern struct can_fake controller;

void fake_reset(void);
        /* An idle bus, and nothing under way. */

#endif
