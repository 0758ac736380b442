#include "host_sim/sim/native/loop.h"
#include "host_sim/sim/native/robot_wire.h"
#include "host_sim/sim/native/turn.h"

static void send_senses(struct loop *loop, struct loop_robot *robot, const struct senses *senses)
{
    robot_wire_senses(robot, senses, &robot->senses);
    log_lines_add(&loop->log, &robot->senses);
    robot->answer_count = loop->exchange(robot->octet, &robot->senses);
}

static bool is_answer(const struct loop_robot *robot, const struct frame *frame, uint8_t tick, struct drive *drive)
{
    return robot_wire_drive(frame, tick, drive)
        || (robot->halted && drive->tick == tick && drive->reason == REASON_STOP);
}

/* Takes one frame from a robot. Refuses a drive that answers other senses. */
static void take_frame(struct loop *loop, struct loop_robot *robot, const struct frame *frame, struct turn *turn)
{
    bool is_drive = frame->id == robot->drive_id;

    if (is_drive && !is_answer(robot, frame, turn->senses.tick, &turn->drive)) {
        robot->refused++;
        return;
    }
    if (is_drive)
        robot->drive = *frame;
    else
        robot_wire_report(robot, frame);
    robot->received++;
    log_lines_add(&loop->log, frame);
}

/* The drive among a robot's answers, or null. */
static const struct frame *driven(const struct loop_robot *robot, const struct frame *answers, uint8_t tick)
{
    struct drive drive = {0};

    for (size_t i = 0; i < robot->answer_count; i++)
        if (answers[i].id == robot->drive_id && is_answer(robot, &answers[i], tick, &drive))
            return &answers[i];
    return NULL;
}

/* Takes all frames of a robot if its drive is among them, otherwise none. */
static bool take_answers(struct loop *loop, struct loop_robot *robot, struct turn *turn)
{
    const struct frame *answers = loop->answers(robot->octet);
    const struct frame *drive = driven(robot, answers, turn->senses.tick);

    if (!drive)
        return false;
    robot_wire_hear_answer(robot, drive);
    robot->report_count = 0;
    robot->has_news = false;
    for (size_t i = 0; i < robot->waiting_count; i++)
        take_frame(loop, robot, &robot->waiting[i], turn);
    robot->waiting_count = 0;
    for (size_t i = 0; i < robot->answer_count; i++)
        take_frame(loop, robot, &answers[i], turn);
    return true;
}

/* Asks a robot that has stopped by itself for a report, then resends its senses. Returns whether its drive came. */
static bool asks_on(struct loop *loop, size_t index, struct turn *turn)
{
    struct loop_robot *robot = &loop->robots[index];

    if (!loop->ask || robot->halted || !loop->ask(loop, index))
        return false;
    robot->halted = true;
    robot->answer_count = loop->exchange(robot->octet, &robot->senses);
    return take_answers(loop, robot, turn);
}

/* As on a bus, the other robots hear a robot's memory reports. They do not answer, so that their own answers stay. */
static void pass_on(struct loop *loop, size_t from, const struct frame *frame)
{
    for (size_t i = 0; i < loop->robot_count; i++)
        if (i != from)
            (void)loop->exchange(loop->robots[i].octet, frame);
}

static void pass_memories_on(struct loop *loop)
{
    for (size_t i = 0; i < loop->robot_count; i++) {
        const struct frame *answers = loop->answers(loop->robots[i].octet);

        for (size_t k = 0; k < loop->robots[i].answer_count; k++)
            if (robot_wire_is_memory(&answers[k]))
                pass_on(loop, i, &answers[k]);
    }
}

/* Sends all robots their senses, and each other's memories, before the first answer is read. */
bool turns_in_process(struct loop *loop, struct turn turns[])
{
    for (loop->sent = 0; loop->sent < loop->robot_count; loop->sent++)
        send_senses(loop, &loop->robots[loop->sent], &turns[loop->sent].senses);
    pass_memories_on(loop);
    for (loop->answered = 0; loop->answered < loop->robot_count; loop->answered++)
        if (!take_answers(loop, &loop->robots[loop->answered], &turns[loop->answered])
            && !asks_on(loop, loop->answered, &turns[loop->answered]))
            return false;
    return true;
}
