/* fleet.h: many robots at once, each with its own core, without frames: the core gets senses and returns a drive.
 *
 * A robot senses and does exactly what it would in a run of loop.h, where frames carry the same. The caller
 * provides all memory. */
#ifndef OCTET_FLEET_H
#define OCTET_FLEET_H

#include "host_sim/world/native/world.h"

struct fleet_core;   /* a robot's firmware: fleet_core_size() bytes */

enum {
    FLEET_REASONS = 16,
    FLEET_SECOND_TICKS = 50,
    FLEET_TRAPPED_TICKS = 3000   /* 60 s: a longer contact counts as one of that length */
};

struct fleet_robot {
    struct fleet_core *core;
    struct world *world;
    struct body *body;                /* its own in that world */
    uint32_t tick;                    /* number of its next tick */
    uint32_t ticks;                   /* in this environment so far */
    uint32_t ticks_max;               /* time limit of the environment */
    uint8_t action;                   /* the last drive's */
    const uint8_t *company;           /* memories of the robots that hear each other, CELL_COUNT bytes each, */
    uint32_t company_size;            /* their number; 0: it hears nobody */
    uint32_t company_place;           /* its own among them */
    uint32_t known_ticks;             /* from the start of the run until it knew a turn for each pattern of a thing on
                                         one side; 0: it does not yet */
    uint32_t begun[FLEET_REASONS];    /* actions begun in this environment, by reason */
    uint32_t food_eaten;              /* in this environment, too: */
    uint32_t denied;                  /* times that its wheels did not do what they were told */
    uint32_t contacts;                /* times that it was blocked, */
    uint32_t blocked_ticks;           /* ticks of all of them, of each at most FLEET_TRAPPED_TICKS, */
    uint32_t blocked_longest;         /* of the longest, */
    uint32_t blocked_now;             /* and of the one that goes on */
    uint32_t met;                     /* patterns at which it was blocked, in the order in which it first was: four
                                         bits each, from bit 0 on. No other cell of its memory made a difference */
};

size_t fleet_core_size(void);
        /* Size of a core, bytes; cores may lie one after the other. */

void fleet_wake(struct fleet_robot *robot);
        /* Initializes a core as after power-up, with an empty memory. */

int fleet_command(struct fleet_robot *robot, int opcode, uint8_t which, uint32_t value, uint32_t *answer);
        /* Executes one command. Returns 0, or the result that says why not. */

void fleet_memories(const struct fleet_robot robots[], size_t count, uint8_t *cells);
        /* Copies the memories of robots, one after the other: CELL_COUNT bytes each. */

size_t fleet_run_alone(struct fleet_robot robots[], size_t count, uint32_t ticks);
        /* Runs each robot in its own world for a number of ticks, one robot after the other, or to the end of its
           environment. Returns how many are not at its end. A robot with company hears it once a second, as it is:
           the caller copies the memories there, and runs no more than a second. */

size_t fleet_run_together(struct fleet_robot robots[], size_t count, uint32_t ticks);
        /* The same for robots that share a world: they sense each other, tick by tick. */

const char *own_failure(const void *robot);
        /* Of robots that are linked with a user's behaviour, only: as in host_sim/program/own/guard.h. */

#endif
