#include "host_sim/sim/native/loop.h"

#include <math.h>

#include "firmware/pattern.h"
#include "host_sim/sim/native/robot_wire.h"

/* Of one robot in one tick. */
struct turn {
    struct senses senses;
    struct drive drive;
};

enum { TURNS_MAX = NODE_MAX };

static void log_frame(struct loop *loop, const struct frame *frame)
{
    if (loop->log.text)
        log_lines_add(&loop->log, frame);
}

static void send_senses(struct loop *loop, struct loop_robot *robot, const struct senses *senses)
{
    struct frame frame = {0};

    robot_wire_senses(robot, senses, &frame);
    log_frame(loop, &frame);
    robot->answer_count = loop->exchange(robot->octet, &frame);
}

/* Takes one frame of a robot; true if it is its drive. A drive that answers other senses is refused. */
static bool take_frame(struct loop *loop, struct loop_robot *robot, const struct frame *frame, struct turn *turn)
{
    bool is_drive = frame->id == robot->drive_id;

    if (is_drive && !robot_wire_drive(frame, turn->senses.tick, &turn->drive)) {
        robot->refused++;
        return false;
    }
    if (is_drive)
        robot->drive = *frame;
    else
        robot_wire_report(robot, frame);
    robot->received++;
    log_frame(loop, frame);
    return is_drive;
}

/* Takes all that a robot has said; true if its drive was there. */
static bool take_answers(struct loop *loop, struct loop_robot *robot, struct turn *turn)
{
    const struct frame *answers = loop->answers(robot->octet);
    bool driven = false;

    robot->report_count = 0;
    robot->has_news = false;
    for (size_t i = 0; i < robot->waiting_count; i++)
        driven |= take_frame(loop, robot, &robot->waiting[i], turn);
    robot->waiting_count = 0;
    for (size_t i = 0; i < robot->answer_count; i++)
        driven |= take_frame(loop, robot, &answers[i], turn);
    return driven;
}

/* All robots hear their senses before the first one's answer is read. */
static bool exchange(struct loop *loop, struct turn turns[])
{
    uint8_t tick = (uint8_t)(loop->tick % TICK_SPAN);

    for (size_t i = 0; i < loop->robot_count; i++) {
        world_sense(loop->world, &loop->world->bodies[i], tick, &turns[i].senses);
        body_faults_sense(&loop->robots[i].faults, loop->tick, &turns[i].senses);
    }
    for (size_t i = 0; i < loop->robot_count; i++)
        send_senses(loop, &loop->robots[i], &turns[i].senses);
    for (size_t i = 0; i < loop->robot_count; i++)
        if (!take_answers(loop, &loop->robots[i], &turns[i])) {
            loop->silent = (int32_t)i;
            return false;
        }
    return true;
}

/* Counts an action that begins, and notes it if it is a decision to learn from. */
static void begin_action(struct loop_robot *robot, const struct turn *turn, uint32_t tick_of_block)
{
    bool tried = robot->begun_any && robot->reason == REASON_TRIAL;

    if (turn->drive.action != robot->action && (unsigned)turn->drive.reason < LOOP_REASONS)
        robot->begun[turn->drive.reason]++;
    robot->begun_any = true;
    robot->pattern = pattern_of(turn->senses.feel);
    if (tried || turn->drive.reason == REASON_REMEMBERED || turn->drive.reason == REASON_TRIAL)
        robot->decisions[robot->decision_count++] = tick_of_block;
}

static void record_row(const struct loop_robot *robot, const struct body *body, const struct turn *turn, int16_t row[])
{
    const struct senses *senses = &turn->senses;
    const struct drive *drive = &turn->drive;
    const int16_t numbers[LOOP_ROW] = {
        senses->tick, senses->feel, senses->bump, senses->look, (int16_t)senses->beacon_mm,
        (int16_t)senses->odometer_left, (int16_t)senses->odometer_right,
        drive->tick, drive->left_mm_s, drive->right_mm_s, (int16_t)drive->reason, drive->repeat_count,
        drive->action, drive->eat, robot->pattern, body->lifted, 0,
    };

    for (unsigned i = 0; i < LOOP_ROW; i++)
        row[i] = numbers[i];
}

static void record(struct loop *loop, size_t index, const struct turn *turn)
{
    struct loop_robot *robot = &loop->robots[index];
    const struct body *body = &loop->world->bodies[index];
    double *pose = robot->poses + (size_t)loop->ticks * LOOP_POSE;

    if (!robot->begun_any || turn->drive.action != robot->action)
        begin_action(robot, turn, loop->ticks);
    robot->action = turn->drive.action;
    robot->reason = (uint8_t)turn->drive.reason;
    pose[0] = body->x_mm;
    pose[1] = body->y_mm;
    pose[2] = body->heading_rad;
    record_row(robot, body, turn, robot->rows + (size_t)loop->ticks * LOOP_ROW);
}

/* Eats and moves; true if something was eaten. */
static bool act(struct loop *loop, size_t index, const struct drive *drive)
{
    struct body *body = &loop->world->bodies[index];
    struct drive wheels = *drive;
    bool eaten = drive->eat && world_eat(loop->world, body);

    loop->robots[index].food_eaten += eaten;
    body_faults_drive(&loop->robots[index].faults, &wheels);
    world_move(loop->world, body, wheels.left_mm_s, wheels.right_mm_s);
    return eaten;
}

/* As on a bus, the others hear what a robot says of its memory. They answer nothing, so that their own answers stay. */
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

/* One tick; true if the block may go on after it. */
static bool run_tick(struct loop *loop)
{
    struct turn turns[TURNS_MAX];
    bool goes_on = true;

    if (loop->log.text)
        log_lines_stamp(&loop->log, (uint64_t)rint(loop->tick * loop->world->params.tick_s * 1e6));
    if (!exchange(loop, turns))
        return false;
    pass_memories_on(loop);
    for (size_t i = 0; i < loop->robot_count; i++) {
        goes_on &= !act(loop, i, &turns[i].drive) && !loop->robots[i].has_news;
        record(loop, i, &turns[i]);
    }
    loop->tick++;
    loop->ticks++;
    return goes_on;
}

static bool has_room(const struct loop *loop)
{
    size_t lines = 0;

    for (size_t i = 0; i < loop->robot_count; i++)
        lines += 1 + LOOP_FRAMES_MAX + loop->robots[i].waiting_count;
    return !loop->log.text || loop->log_size - loop->log.used >= lines * LOG_LINE_MAX;
}

void loop_run(struct loop *loop, uint32_t ticks_max)
{
    bool goes_on = true;

    loop->ticks = 0;
    loop->log.used = 0;
    loop->silent = -1;
    for (size_t i = 0; i < loop->robot_count; i++)
        loop->robots[i].decision_count = 0;
    while (goes_on && loop->ticks < ticks_max && has_room(loop))
        goes_on = run_tick(loop);
}
