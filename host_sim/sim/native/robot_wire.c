#include "host_sim/sim/native/robot_wire.h"

#include <string.h>

#include "hal/protocol/e2e.h"
#include "octet.h"

#define SENT(member, signal) .signal = senses->member,

void robot_wire_senses(struct loop_robot *robot, const struct senses *senses, struct frame *out)
{
    struct octet_senses_t message = {
        .counter = e2e_next(robot->senses_counter),
        ROBOT_SENSED(SENT)
    };

    robot->senses_counter = message.counter;
    out->id = robot->senses_id;
    out->len = OCTET_SENSES_LENGTH;
    (void)octet_senses_pack(out->data, &message, sizeof out->data);
    e2e_protect(out);
}

#define TAKEN(member, signal) out->member = message.signal;

bool robot_wire_drive(const struct frame *frame, uint8_t tick, struct drive *out)
{
    struct octet_drive_t message;

    if (octet_drive_unpack(&message, frame->data, frame->len) != 0)
        return false;
    ROBOT_DRIVEN(TAKEN)
    return message.tick == tick && message.reason != REASON_STOP && message.reason != REASON_SILENCE
        && octet_drive_reason_is_in_range(message.reason);
}

enum { KIND = 1, CONTENT = 2 };   /* bytes: counter (low half) and page (high half); first byte of the content */

static bool same_kind(const struct frame *a, const struct frame *b)
{
    return a->id == b->id && a->data[KIND] >> 4 == b->data[KIND] >> 4;
}

/* The last report of this kind; null if there was none. */
static struct frame *known(struct loop_robot *robot, const struct frame *frame)
{
    for (size_t i = 0; i < robot->known_count; i++)
        if (same_kind(&robot->known[i], frame))
            return &robot->known[i];
    return NULL;
}

static bool says_the_same(const struct frame *before, const struct frame *frame)
{
    return memcmp(before->data + CONTENT, frame->data + CONTENT, sizeof frame->data - CONTENT) == 0;
}

static bool is_news(struct loop_robot *robot, const struct frame *frame)
{
    struct frame *before = known(robot, frame);

    if (before && says_the_same(before, frame))
        return false;
    if (!before && robot->known_count < LOOP_KINDS_MAX)
        before = &robot->known[robot->known_count++];
    if (before)
        *before = *frame;
    return true;
}

void robot_wire_report(struct loop_robot *robot, const struct frame *frame)
{
    robot->has_news |= frame->id != robot->heartbeat_id && is_news(robot, frame);
    if (robot->report_count == LOOP_FRAMES_MAX)
        memmove(robot->reports, robot->reports + 1, --robot->report_count * sizeof *frame);
    robot->reports[robot->report_count++] = *frame;
}

static bool says_the_same_later(const struct frame *before, const struct frame *frame)
{
    struct octet_heartbeat_t a, b;

    if (octet_heartbeat_unpack(&a, before->data, before->len) != 0 ||
        octet_heartbeat_unpack(&b, frame->data, frame->len) != 0)
        return false;
    return a.profile == b.profile && a.owner == b.owner && a.layout == b.layout;
}

bool robot_wire_goes_on(struct loop_robot *robot, const struct frame *frame)
{
    struct frame *before = known(robot, frame);
    bool same;

    if (!before || !e2e_is_whole(frame, before->len) || e2e_counter(frame) != e2e_next(e2e_counter(before)))
        return false;
    same = frame->id == robot->heartbeat_id ? says_the_same_later(before, frame) : says_the_same(before, frame);
    if (same) {
        *before = *frame;
        robot->told[before - robot->known] = robot->received + 1;
    }
    return same;
}

bool robot_wire_is_memory(const struct frame *frame)
{
    return frame->id >= OCTET_MEMORY_FRAME_ID && frame->id < OCTET_MEMORY_FRAME_ID + NODE_MAX;
}
