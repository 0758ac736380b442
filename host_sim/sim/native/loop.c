#include "host_sim/sim/native/loop.h"

#include <math.h>

#include "host_sim/sim/native/turn.h"

enum { TURNS_MAX = NODE_MAX };

static void sense(const struct loop *loop, struct turn turns[])
{
    for (size_t i = 0; i < loop->robot_count; i++)
        world_sense(loop->world, &loop->world->bodies[i], loop->tick, &turns[i].senses);
}

#define SENSED(member, signal) (int16_t)turn->senses.member,
#define DRIVEN(member, signal) (int16_t)turn->drive.member,

/* Writes senses and drive, the first numbers of a row. */
static void fill_row(const struct turn *turn, int16_t row[])
{
    const int16_t numbers[ROW_PATTERN] = {ROBOT_SENSED(SENSED) ROBOT_DRIVEN(DRIVEN)};

    for (unsigned i = 0; i < ROW_PATTERN; i++)
        row[i] = numbers[i];
}

static void record(struct loop_robot *robot, const struct body *body, uint32_t tick_of_block)
{
    int16_t *row = robot->rows + (size_t)tick_of_block * ROW_COUNT;
    double *pose = robot->poses + (size_t)tick_of_block * LOOP_POSE;

    if (row[ROW_ACTION] != robot->action && (unsigned)row[ROW_REASON] < LOOP_REASONS)
        robot->begun[row[ROW_REASON]]++;
    robot->action = (uint8_t)row[ROW_ACTION];
    row[ROW_PATTERN] = 0;
    row[ROW_LIFTED] = body->lifted;
    row[ROW_FROZEN] = 0;
    pose[0] = body->x_mm;
    pose[1] = body->y_mm;
    pose[2] = body->heading_rad;
}

void loop_record(struct loop *loop)
{
    for (size_t i = 0; i < loop->robot_count; i++)
        record(&loop->robots[i], &loop->world->bodies[i], loop->ticks);
    loop->tick++;
    loop->ticks++;
}

/* Eats and moves; true if something was eaten. */
static bool act(struct loop *loop, size_t index, const struct drive *drive)
{
    struct body *body = &loop->world->bodies[index];
    bool eaten = drive->eat && world_eat(loop->world, body);

    loop->robots[index].food_eaten += eaten;
    world_move(loop->world, body, drive->left_mm_s, drive->right_mm_s);
    return eaten;
}

/* One tick; true if the block may go on after it. */
static bool run_tick(struct loop *loop)
{
    struct turn turns[TURNS_MAX];
    bool goes_on = true;

    if (loop->log.text)
        log_lines_stamp(&loop->log, (uint64_t)rint(loop->tick * loop->world->params.tick_s * 1e6));
    sense(loop, turns);
    if (!(loop->take_turns ? loop->take_turns : turns_in_process)(loop, turns)) {
        loop->handed_over = true;
        return false;
    }
    for (size_t i = 0; i < loop->robot_count; i++) {
        goes_on &= !act(loop, i, &turns[i].drive) && !loop->robots[i].has_news;
        fill_row(&turns[i], loop->robots[i].rows + (size_t)loop->ticks * ROW_COUNT);
    }
    loop_record(loop);
    return goes_on;
}

static bool has_room(const struct loop *loop)
{
    size_t each = 1 + LOOP_FRAMES_MAX + (loop->ask ? LOOP_ASK_LINES : 0), lines = 0;

    for (size_t i = 0; i < loop->robot_count; i++)
        lines += each + loop->robots[i].waiting_count;
    return !loop->log.text || loop->log_size - loop->log.used >= lines * LOG_LINE_MAX;
}

static void begin_block(struct loop_robot *robot)
{
    robot->received = robot->refused = 0;
    for (size_t i = 0; i < LOOP_KINDS_MAX; i++)
        robot->told[i] = 0;
}

void loop_run(struct loop *loop, uint32_t ticks_max)
{
    bool goes_on = true;

    loop->ticks = 0;
    loop->log.used = 0;
    loop->handed_over = false;
    for (size_t i = 0; i < loop->robot_count; i++)
        begin_block(&loop->robots[i]);
    while (goes_on && loop->ticks < ticks_max && has_room(loop))
        goes_on = run_tick(loop);
}
