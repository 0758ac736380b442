#include "can_queue_rig.h"

#include "hal/stm32/machine.h"

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
