#include <stdlib.h>

#include "hal/protocol/e2e.h"
#include "host_sim/sim/native/loop.h"
#include "host_sim/sim/native/robot_wire.h"
#include "host_sim/sim/native/turn.h"

/* Sends the next robot its senses. Returns whether its bus accepted them. */
static bool send_senses(struct loop *loop, const struct senses *senses)
{
    struct loop_robot *robot = &loop->robots[loop->sent];

    robot_wire_senses(robot, senses, &robot->senses);
    if (link_send(robot->link, &robot->senses) != 0)
        return false;
    log_lines_add(&loop->log, &robot->senses);
    return true;
}

/* Whether the body can do these speeds. Faster ones are left to Python. */
static bool is_slow(const struct loop *loop, const struct drive *drive)
{
    double limit = loop->world->params.max_wheel_speed_mm_s;

    return abs(drive->left_mm_s) <= limit && abs(drive->right_mm_s) <= limit;
}

/* Whether a frame answers the senses of this tick, and fills *drive. A robot answers once. */
static bool is_answer(const struct loop_robot *robot, const struct frame *frame, uint8_t tick, struct drive *drive)
{
    return frame->id == robot->drive_id && e2e_is_whole(frame, sizeof frame->data) &&
           e2e_counter(frame) == robot->senses_counter && robot_wire_drive(frame, tick, drive);
}

static void accept(struct loop_robot *robot, const struct frame *drive)
{
    robot->drive = *drive;
    robot_wire_hear_answer(robot, drive);
}

/* Receives frames from the next robot that has not answered. True: they are routine, and end with its drive. */
static bool take_drive(struct loop *loop, struct turn *turn)
{
    struct loop_robot *robot = &loop->robots[loop->answered];
    const struct frame *frame = &loop->in_hand;
    bool driven = false;

    for (unsigned i = 0; i < LOOP_FRAMES_MAX && !driven; i++) {
        loop->received = link_receive(robot->link, &loop->in_hand, loop->wait_ms);
        if (loop->received != 1)
            return false;
        driven = is_answer(robot, frame, turn->senses.tick, &turn->drive) && is_slow(loop, &turn->drive);
        if (driven)
            accept(robot, frame);
        else if (!robot_wire_goes_on(robot, frame))
            return false;
        robot->received++;
        log_lines_add(&loop->log, frame);
    }
    loop->received = 0;
    return driven;
}

bool turns_over_links(struct loop *loop, struct turn turns[])
{
    loop->received = 0;
    for (loop->sent = loop->answered = 0; loop->sent < loop->robot_count; loop->sent++)
        if (!send_senses(loop, &turns[loop->sent].senses))
            return false;
    for (; loop->answered < loop->robot_count; loop->answered++)
        if (!take_drive(loop, &turns[loop->answered]))
            return false;
    return true;
}
