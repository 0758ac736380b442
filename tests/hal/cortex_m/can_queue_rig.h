/* can_queue_rig.h: a queue in front of a fake controller. */
#ifndef OCTET_CAN_QUEUE_RIG_H
#define OCTET_CAN_QUEUE_RIG_H

#include "tests/test.h"
#include "hal/port/cortex_m/can_controller.h"
#include "hal/port/cortex_m/can_queue.h"

/* The fake CAN controller, behind can_controller.h. Time passes whenever the driver reads the clock. */

enum { FAKE_SENT_MAX = 300, LOOK_US = 50 };

struct can_fake {
    uint32_t now_us;
    uint32_t frame_us;        /* that the next frame needs to leave; 0: it never does */
    uint32_t since_us;        /* when the one under way began */
    bool refuses;             /* takes no frame, though a buffer is free */
    bool keeps;               /* aborts nothing */
    uint32_t waiting;         /* bit n: buffer n is taken */
    struct frame buffers[CAN_BUFFERS];
    unsigned order[CAN_BUFFERS];   /* which frame it was, of all that were taken */
    unsigned taken;
    uint32_t ids_elsewhere;   /* what can_waiting_id has for buffers that are free */
    struct frame sent[FAKE_SENT_MAX];
    unsigned sent_count;
    uint32_t aborted;         /* buffers of the last can_abort */
};

extern struct can_fake controller;

void fake_reset(void);
        /* An idle bus, and nothing under way. */

enum { DRIVE = 0x041, ANSWER = 0x141, MEMORY = 0x681, HEARTBEAT = 0x6A1, HEALTH = 0x7C1 };

extern struct can_queue queue;   /* empty */

bool put(uint32_t id, uint8_t number);
        /* As can_queue_put, with a numbered frame. */

uint32_t now_ms(void);
        /* What the driver's clock shows; no time passes. */

void pass_ms(uint32_t ms);
        /* The queue is given time to send. */

void block(void);
        /* From now on no frame leaves. */

void fill_controller(uint32_t first, uint32_t second, uint32_t third);
        /* Frames with these identifiers are stuck in the controller's buffers. */

void assert_sent(unsigned n, uint32_t id, uint8_t number);
        /* The n-th frame that left. */

#endif
