/* can_queue_rig.h: a queue in front of a fake controller. */
#ifndef OCTET_CAN_QUEUE_RIG_H
#define OCTET_CAN_QUEUE_RIG_H

#include <string.h>

#include "tests/test.h"
#include "hal/port/cortex_m/can_controller.h"
#include "hal/port/cortex_m/can_queue.h"
#include "hal/stm32/chip.h"

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

static struct can_fake controller;

enum { DRIVE = 0x041, ANSWER = 0x141, MEMORY = 0x681, HEARTBEAT = 0x6A1, HEALTH = 0x7C1 };

static struct can_queue queue;   /* empty */

/* An idle bus, and nothing under way. */
static inline void fake_reset(void)
{
    memset(&controller, 0, sizeof controller);
    controller.now_us = 5000000;
    controller.frame_us = 250;
}

static bool goes_before(unsigned a, unsigned b)
{
    uint32_t id_a = controller.buffers[a].id, id_b = controller.buffers[b].id;

    return id_a < id_b || (id_a == id_b && controller.order[a] < controller.order[b]);
}

static unsigned next_to_leave(void)
{
    unsigned next = CAN_BUFFERS;

    for (unsigned n = 0; n < CAN_BUFFERS; n++)
        if (controller.waiting >> n & 1u && (next == CAN_BUFFERS || goes_before(n, next)))
            next = n;
    return next;
}

static void let_leave(void)
{
    unsigned n = next_to_leave();

    if (n == CAN_BUFFERS || controller.frame_us == 0 || controller.now_us - controller.since_us < controller.frame_us)
        return;
    controller.sent[controller.sent_count++ % FAKE_SENT_MAX] = controller.buffers[n];
    controller.waiting &= ~(1u << n);
    controller.since_us = controller.now_us;
}

uint32_t machine_ms(void)
{
    controller.now_us += LOOK_US;
    let_leave();
    return controller.now_us / 1000;
}

bool can_put(const struct frame *frame)
{
    for (unsigned n = 0; n < CAN_BUFFERS && !controller.refuses; n++)
        if (!(controller.waiting >> n & 1u)) {
            if (controller.waiting == 0)
                controller.since_us = controller.now_us;
            controller.buffers[n] = *frame;
            controller.order[n] = ++controller.taken;
            controller.waiting |= 1u << n;
            return true;
        }
    return false;
}

uint32_t can_waiting(void)
{
    return controller.waiting;
}

uint32_t can_waiting_id(unsigned n)
{
    return controller.waiting >> n & 1u ? controller.buffers[n].id : controller.ids_elsewhere;
}

void can_abort(uint32_t buffers)
{
    controller.aborted = buffers;
    if (!controller.keeps)
        controller.waiting &= ~buffers;
}

void setUp(void)
{
    fake_reset();
    can_queue_begin(&queue, 500000);
}

/* As can_queue_put, with a numbered frame. */
static inline bool put(uint32_t id, uint8_t number)
{
    struct frame frame = {.id = id, .len = 1, .data = {number}};

    return can_queue_put(&queue, &frame);
}

/* What the driver's clock shows; no time passes. */
static inline uint32_t now_ms(void)
{
    return controller.now_us / 1000;
}

/* The queue is given time to send. */
static inline void pass_ms(uint32_t ms)
{
    uint32_t end = controller.now_us + 1000 * ms;

    while (controller.now_us < end)
        (void)can_queue_pump(&queue);
}

/* From now on no frame leaves. */
static inline void block(void)
{
    controller.frame_us = 0;
}

/* Frames with these identifiers are stuck in the controller's buffers. */
static inline void fill_controller(uint32_t first, uint32_t second, uint32_t third)
{
    block();
    controller.waiting = 7;
    queue.moved_ms = now_ms();
    controller.buffers[0].id = first;
    controller.buffers[1].id = second;
    controller.buffers[2].id = third;
}

/* The n-th frame that left. */
static inline void assert_sent(unsigned n, uint32_t id, uint8_t number)
{
    TEST_ASSERT_LESS_THAN_UINT(controller.sent_count, n);
    TEST_ASSERT_EQUAL_HEX32(id, controller.sent[n].id);
    TEST_ASSERT_EQUAL_UINT8(number, controller.sent[n].data[0]);
}

#endif
