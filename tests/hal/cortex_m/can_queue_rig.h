/* can_queue_rig.h: a queue before a controller that takes and sends as a test says. */
#ifndef OCTET_CAN_QUEUE_RIG_H
#define OCTET_CAN_QUEUE_RIG_H

#include "tests/test.h"
#include "can_controller_fake.h"
#include "hal/port/cortex_m/can_queue.h"

enum { DRIVE = 0x041, ANSWER = 0x141, MEMORY = 0x681, HEARTBEAT = 0x6A1, HEALTH = 0x7C1 };

extern struct can_queue queue;   /* empty */

bool put(uint32_t id, uint8_t number);
        /* As can_queue_put, with a frame that can be told from others. */

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
