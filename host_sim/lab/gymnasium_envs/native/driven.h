/* driven.h: robots with an external brain. The learner chooses the next action, and the firmware's own motion carries
 * it out in the world of host_sim/world/native. The caller provides all memory. */
#ifndef OCTET_DRIVEN_H
#define OCTET_DRIVEN_H

#include "host_sim/world/native/world.h"

/* What a brain may do. Turns are as large as the article's. */
enum driven_action {
    DRIVEN_FORWARD,      /* a step, which ends early at an obstacle; at its end the robot eats what is within reach */
    DRIVEN_TURN_LEFT,    /* as a remembered turn */
    DRIVEN_TURN_RIGHT,
    DRIVEN_TRY_LEFT,     /* as a trial */
    DRIVEN_TRY_RIGHT,
    DRIVEN_TURN_ABOUT,
    DRIVEN_ACTIONS
};

enum { DRIVEN_SENSES = 7 };   /* the fields of struct senses up to the odometers, in their order */

/* One robot after its action. */
struct driven_robot {
    int32_t senses[DRIVEN_SENSES];
    uint32_t food_eaten;    /* pieces, in the last step */
    uint32_t collisions;    /* times that it began to touch something, in the last step */
};

/* A world whose robots carry out given actions. */
struct driven {
    struct world *world;
    struct motion *motions;       /* driven_motion_size() bytes for each body */
    struct driven_robot *robots;    /* one for each body */
    uint32_t tick;                /* number of the next tick */
    uint32_t limit_ticks;         /* after which nothing happens any more */
    uint32_t step_ticks;          /* after which a step ends, whatever is under way */
    uint32_t food_left;           /* pieces */
};

size_t driven_motion_size(void);
        /* Size of a body's motion, bytes. */

void driven_begin(struct driven *driven);
        /* Puts the robots at rest and fills in what they sense. */

void driven_step(struct driven all[], size_t count, const uint8_t actions[]);
        /* Has each robot carry out its action, in several worlds with equal numbers of bodies. A world's step ends
           when its last robot is done; the others rest meanwhile. It ends earlier when all food is eaten, or when the
           time of the step or of the world is up. */

#endif
