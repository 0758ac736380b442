#include "can_queue_rig.h"

#include "hal/stm32/chip.h"

#include <string.h>

struct can_fake controller;

void fake_reset(void)
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

struct can_queue queue;

void setUp(void)
{
    fake_reset();
    can_queue_begin(&queue, 500000);
}

bool put(uint32_t id, uint8_t number)
{
    struct frame frame = {.id = id, .len = 1, .data = {number}};

    return can_queue_put(&queue, &frame);
}

uint32_t now_ms(void)
{
    return controller.now_us / 1000;
}

void pass_ms(uint32_t ms)
{
    uint32_t end = controller.now_us + 1000 * ms;

    while (controller.now_us < end)
        (void)can_queue_pump(&queue);
}

void block(void)
{
    controller.frame_us = 0;
}

void fill_controller(uint32_t first, uint32_t second, uint32_t third)
{
    block();
    controller.waiting = 7;
    queue.moved_ms = now_ms();
    controller.buffers[0].id = first;
    controller.buffers[1].id = second;
    controller.buffers[2].id = third;
}

void assert_sent(unsigned n, uint32_t id, uint8_t number)
{
    TEST_ASSERT_LESS_THAN_UINT(controller.sent_count, n);
    TEST_ASSERT_EQUAL_HEX32(id, controller.sent[n].id);
    TEST_ASSERT_EQUAL_UINT8(number, controller.sent[n].data[0]);
}
