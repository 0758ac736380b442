#include "host_sim/web/native/page_frames.h"

#include <string.h>

#include "hal/protocol/e2e.h"
#include "octet.h"

struct octet *page_octet(uint32_t robot)
{
    return page_state()->robots[robot].octet;
}

size_t page_exchange(uint32_t robot, uint32_t id, uint32_t len)
{
    struct frame frame = {.id = id, .len = (uint8_t)len};

    memcpy(frame.data, page_bytes(), sizeof frame.data);
    return octet_exchange(page_octet(robot), &frame);
}

const struct frame *page_answers(uint32_t robot)
{
    return octet_answers(page_octet(robot));
}

void page_hear(uint32_t robot, const struct frame *frame)
{
    struct loop_robot *to = &page_state()->robots[robot];
    size_t count = octet_exchange(to->octet, frame);

    for (size_t i = 0; i < count && to->waiting_count < PAGE_WAITING_MAX; i++)
        page_state()->waiting[robot][to->waiting_count++] = octet_answers(to->octet)[i];
}

bool page_take(uint32_t robot, struct frame *out)
{
    struct loop_robot *from = &page_state()->robots[robot];
    struct frame *waiting = page_state()->waiting[robot];

    if (from->waiting_count == 0)
        return false;
    *out = waiting[0];
    memmove(waiting, waiting + 1, --from->waiting_count * sizeof *waiting);
    log_lines_add(&page_state()->loop.log, out);
    return true;
}

void page_send_ranges(uint32_t robot, uint32_t tick)
{
    const struct loop_robot *to = &page_state()->robots[robot];
    uint8_t range[FEEL_COUNT];
    struct frame frame = {.id = wire_id(&page_octet(robot)->wire, OCTET_RANGES_FRAME_ID), .len = OCTET_RANGES_LENGTH};
    struct octet_ranges_t message = {
        .counter = e2e_next(to->senses_counter),
        .tick = (uint8_t)(tick & (TICK_SPAN - 1)),
    };

    page_measure(robot, tick, range);
    message.range_right = range[0];
    message.range_front_right = range[1];
    message.range_front = range[2];
    message.range_front_left = range[3];
    message.range_left = range[4];
    (void)octet_ranges_pack(frame.data, &message, sizeof frame.data);
    e2e_protect(&frame);
    log_lines_add(&page_state()->loop.log, &frame);
    page_hear(robot, &frame);
}

void page_take_reports(uint32_t robot)
{
    struct frame frame;

    while (page_take(robot, &frame))
        continue;
}
