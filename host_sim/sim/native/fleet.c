#include "host_sim/sim/native/fleet.h"

#include <string.h>

#include "firmware/memory/memory.h"
#include "firmware/pattern.h"
#include "firmware/robot.h"

struct fleet_core {
    struct robot robot;
    struct input in;   /* its last senses */
};

size_t fleet_core_size(void)
{
    return sizeof(struct fleet_core);
}

void fleet_wake(struct fleet_robot *robot)
{
    static const uint8_t nothing[CELL_COUNT] = {SIDE_NOTHING};

    robot_init(&robot->core->robot, 0);
    (void)brain_adopt(&robot->core->robot.brain, nothing);
}

int fleet_command(struct fleet_robot *robot, int opcode, uint8_t which, uint32_t value, uint32_t *answer)
{
    const struct command command = {.opcode = (enum opcode)opcode, .which = which, .value = value};

    *answer = 0;
    return (int)robot_execute(&robot->core->robot, &command, answer);
}

void fleet_memories(const struct fleet_robot robots[], size_t count, uint8_t *cells)
{
    for (size_t i = 0; i < count * CELL_COUNT; i++)
        cells[i] = robots[i / CELL_COUNT].core->robot.brain.memory.cell[i % CELL_COUNT];
}

static void hear(struct fleet_robot *robot)
{
    struct input in;
    struct output out;

    for (uint32_t half = 0; half < 2 * robot->company_size; half++) {
        if (half / 2 == robot->company_place)
            continue;
        in.peer.upper = half % 2;
        memcpy(in.peer.cell, robot->company + half * sizeof in.peer.cell, sizeof in.peer.cell);
        robot_respond(&robot->core->robot, INPUT_PEER, &in, &out);
    }
}

static void note_known(struct fleet_robot *robot)
{
    struct memory memory = robot->core->robot.brain.memory;

    (void)memory_translate(&memory, MEMORY_KIND_SIDES);
    if (memory.cell[1] && memory.cell[3] && memory.cell[4] && memory.cell[6])
        robot->known_ticks = robot->tick + 1;
}

static void sense(struct fleet_robot *robot)
{
    if (robot->company_size && robot->tick % FLEET_SECOND_TICKS == 0)
        hear(robot);
    world_sense(robot->world, robot->body, robot->tick, &robot->core->in.senses);
}

/* A contact lasts from blocked to clear, as in host_sim/lab/study/contacts.py. */
static void note_contact(struct fleet_robot *robot, enum reason reason)
{
    if (!((unsigned)AVOIDING_REASONS >> reason & 1u)) {
        robot->blocked_now = 0;
        return;
    }
    robot->contacts += robot->blocked_now == 0;
    robot->blocked_ticks += robot->blocked_now < FLEET_TRAPPED_TICKS;
    robot->blocked_now++;
    if (robot->blocked_now > robot->blocked_longest)
        robot->blocked_longest = robot->blocked_now;
}

static void note_met(struct fleet_robot *robot)
{
    uint32_t pattern = pattern_of(robot->core->robot.brain.tried_feel);
    unsigned bit = 0;

    for (; robot->met >> bit & 0xFu; bit += 4)
        if ((robot->met >> bit & 0xFu) == pattern)
            return;
    robot->met |= pattern << bit;
}

/* Has the core decide by its senses, and carries out its decision in the world. */
static void act(struct fleet_robot *robot)
{
    struct output out;

    robot_respond(&robot->core->robot, INPUT_SENSES, &robot->core->in, &out);
    if (out.drive.action != robot->action && (unsigned)out.drive.reason < FLEET_REASONS)
        robot->begun[out.drive.reason]++;
    robot->action = out.drive.action;
    robot->denied += out.denied;
    note_contact(robot, out.drive.reason);
    note_met(robot);
    if (robot->known_ticks == 0 && (out.store || robot->tick == 0))
        note_known(robot);
    if (out.drive.eat)
        robot->food_eaten += world_eat(robot->world, robot->body);
    world_move(robot->world, robot->body, out.drive.left_mm_s, out.drive.right_mm_s);
    robot->tick++;
    robot->ticks++;
}

static bool is_over(const struct fleet_robot *robot)
{
    return robot->ticks >= robot->ticks_max || world_food_left(robot->world) == 0;
}

size_t fleet_run_alone(struct fleet_robot robots[], size_t count, uint32_t ticks)
{
    size_t left = 0;

    for (size_t i = 0; i < count; i++) {
        struct fleet_robot *robot = &robots[i];

        for (uint32_t tick = 0; tick < ticks && !is_over(robot); tick++) {
            sense(robot);
            act(robot);
        }
        left += !is_over(robot);
    }
    return left;
}

size_t fleet_run_together(struct fleet_robot robots[], size_t count, uint32_t ticks)
{
    for (uint32_t tick = 0; tick < ticks && !is_over(robots); tick++) {
        for (size_t i = 0; i < count; i++)
            sense(&robots[i]);
        for (size_t i = 0; i < count; i++)
            act(&robots[i]);
    }
    return is_over(robots) ? 0 : count;
}
