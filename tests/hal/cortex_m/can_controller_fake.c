#include "can_controller_fake.h"

#include <string.h>

#include "hal/stm32/machine.h"

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
