#include "hal/port/cortex_m/can_queue.h"

#include "hal/port/cortex_m/can_controller.h"
#include "hal/port/cortex_m/systick.h"

enum { FRAME_BITS = 135 };   /* a full frame with maximum stuff bits and the interframe space */

void can_queue_begin(struct can_queue *queue, uint32_t bitrate)
{
    uint32_t all_ms = 1000u * FRAME_BITS * (CAN_QUEUE_MAX + CAN_BUFFERS) / bitrate + 1u;

    *queue = (struct can_queue){
        .stuck_ms = (uint8_t)(1000u * FRAME_BITS / bitrate + 1u),
        .drain_ms = (uint8_t)(all_ms < LINK_SEND_MS ? all_ms : (uint32_t)LINK_SEND_MS),
    };
}

static void note_dropped(struct can_queue *queue, unsigned more)
{
    unsigned sum = queue->dropped + more;

    queue->dropped = (uint8_t)(sum < UINT8_MAX ? sum : UINT8_MAX);
}

static unsigned count_of(uint32_t buffers)
{
    return (buffers & 1u) + (buffers >> 1 & 1u) + (buffers >> 2 & 1u);
}

void can_queue_drop(struct can_queue *queue)
{
    uint32_t waiting = can_waiting();

    can_abort(waiting);
    note_dropped(queue, count_of(waiting) + queue->count);
    queue->count = 0;
}

/* The controller's last buffer is reserved for urgent frames. */
unsigned can_queue_pump(struct can_queue *queue)
{
    uint32_t now = machine_ms();
    unsigned inside = count_of(can_waiting());
    unsigned waiting = inside + queue->count;

    if (waiting == 0 || waiting < queue->waiting)
        queue->moved_ms = now;
    queue->waiting = waiting;
    if (queue->count > 0 && inside < CAN_BUFFERS - 1u && can_put(&queue->frames[queue->first])) {
        queue->first = (uint8_t)((queue->first + 1u) % CAN_QUEUE_MAX);
        queue->count--;
    }
    return waiting;
}

/* Waits until at most this many frames are left. Returns false if they are not sent in time. */
static bool drain(struct can_queue *queue, unsigned left)
{
    uint32_t start = machine_ms();

    while (can_queue_pump(queue) > left) {
        uint32_t now = machine_ms();   /* read after the check, whose time it is compared with */

        if (now - queue->moved_ms > queue->stuck_ms || now - start > queue->drain_ms)
            return false;
    }
    return true;
}

static bool is_urgent(const struct can_queue *queue, uint32_t id)
{
    uint32_t waiting = can_waiting();

    for (unsigned n = 0; n < CAN_BUFFERS; n++)
        if (waiting >> n & 1u && can_waiting_id(n) <= id)
            return false;
    for (unsigned i = 0; i < queue->count; i++)
        if (queue->frames[(queue->first + i) % CAN_QUEUE_MAX].id <= id)
            return false;
    return true;
}

/* If all buffers are in use, drops the least urgent frame. */
static void make_room(struct can_queue *queue)
{
    unsigned last = 0;

    if (count_of(can_waiting()) < CAN_BUFFERS)
        return;
    for (unsigned n = 1; n < CAN_BUFFERS; n++)
        if (can_waiting_id(n) > can_waiting_id(last))
            last = n;
    can_abort(1u << last);
    note_dropped(queue, 1);
    queue->waiting--;   /* a dropped frame was not sent */
}

static bool put_first(struct can_queue *queue, const struct frame *frame)
{
    uint32_t start = machine_ms();

    if (!drain(queue, 0))
        make_room(queue);
    while (!can_put(frame))
        if (machine_ms() - start > LINK_SEND_MS)
            return false;
    return true;
}

static bool put_last(struct can_queue *queue, const struct frame *frame)
{
    if (!drain(queue, CAN_QUEUE_MAX - 1) && queue->count == CAN_QUEUE_MAX)
        return false;
    queue->frames[(queue->first + queue->count) % CAN_QUEUE_MAX] = *frame;
    queue->count++;
    return true;
}

static bool put(struct can_queue *queue, const struct frame *frame)
{
    unsigned waiting = can_queue_pump(queue);

    if (waiting > 0 && machine_ms() - queue->moved_ms > LINK_SEND_MS) {
        can_queue_drop(queue);
        waiting = can_queue_pump(queue);
    }
    if (waiting == 0)
        return can_put(frame);
    return is_urgent(queue, frame->id) ? put_first(queue, frame) : put_last(queue, frame);
}

bool can_queue_put(struct can_queue *queue, const struct frame *frame)
{
    bool taken = put(queue, frame);

    if (taken)
        queue->waiting++;   /* otherwise a frame sent in its place would go unnoticed */
    else
        note_dropped(queue, 1);
    (void)can_queue_pump(queue);
    return taken;
}
