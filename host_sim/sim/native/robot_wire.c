#include "host_sim/sim/native/robot_wire.h"

#include <string.h>

#include "hal/flash_store/crc32.h"
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

/* The check over the senses up to the last ones, and over the drives before them. */
static uint32_t heard_now(const struct loop_robot *robot)
{
    uint8_t both[OCTET_SENSES_LENGTH];

    for (unsigned i = 1; i < OCTET_SENSES_LENGTH; i++)
        both[i] = robot->senses.data[i] ^ robot->driven[i];
    return crc32_more(robot->heard[(robot->heard_count - 1) % LOOP_HEARD], &both[1], OCTET_SENSES_LENGTH - 1u);
}

void robot_wire_hear_answer(struct loop_robot *robot, const struct frame *drive)
{
    uint32_t heard = heard_now(robot);

    robot->heard[robot->heard_count++ % LOOP_HEARD] = heard;
    memcpy(robot->driven, drive->data, sizeof robot->driven);
}

enum { KIND = 1, CONTENT = 2, HELD = 6 };   /* bytes: counter (low half) and page (high half); first byte of the
                                               content, and of HEALTH's held */

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

/* HEALTH's held changes with each tick. */
static bool says_the_same(const struct loop_robot *robot, const struct frame *before, const struct frame *frame)
{
    size_t end = frame->id == robot->health_id ? HELD : sizeof frame->data;

    return memcmp(before->data + CONTENT, frame->data + CONTENT, end - CONTENT) == 0;
}

static bool is_news(struct loop_robot *robot, const struct frame *frame)
{
    struct frame *before = known(robot, frame);

    if (before && says_the_same(robot, before, frame))
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

/* A HEALTH that comes after the drive of its tick is left to Python. */
static bool is_held(const struct loop_robot *robot, const struct frame *frame)
{
    uint32_t held = robot->commands ^ heard_now(robot);

    return frame->data[HELD] == (uint8_t)held && frame->data[HELD + 1] == (uint8_t)(held >> 8);
}

static bool says_nothing_new(const struct loop_robot *robot, const struct frame *before, const struct frame *frame)
{
    if (frame->id == robot->heartbeat_id)
        return says_the_same_later(before, frame);
    return says_the_same(robot, before, frame) && (frame->id != robot->health_id || is_held(robot, frame));
}

bool robot_wire_goes_on(struct loop_robot *robot, const struct frame *frame)
{
    struct frame *before = known(robot, frame);
    bool same;

    if (!before || !e2e_is_whole(frame, before->len) || e2e_counter(frame) != e2e_next(e2e_counter(before)))
        return false;
    same = says_nothing_new(robot, before, frame);
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
