/* munk_space.h: a space that pymunk has built, stepped by pymunk's own physics. From munk_space_borrow to
 * munk_space_return its collisions are handled here. */
#ifndef OCTET_MUNK_SPACE_H
#define OCTET_MUNK_SPACE_H

#include "host_sim/world/native/munk.h"
#include "host_sim/world/native/world.h"

/* A body's place in the space. */
struct munk_place {
    struct munk_body *in_space;
    struct munk_shape *disc;
    struct munk_vector in_the_air;
    struct munk_filter sight;
    uintptr_t first_cone;      /* collision type of cone 0; the others follow */
};

/* Data of a cone's collision handlers. */
struct munk_cone {
    struct body *body;
    uint8_t number;
};

/* A collision handler of the space, and what it was before. */
struct munk_loan {
    struct munk_handler *handler;
    struct munk_handler before;
};

struct munk_world {
    struct space space;
    const struct munk *munk;
    struct munk_space *stepped;
    struct world *world;
    uintptr_t obstacle_type;   /* collision types of obstacles and of the bodies' discs */
    uintptr_t disc_type;
    double reach_mm;           /* of a body's cones, from its centre to their farthest corners */
    double free_mm;            /* how far a body that is alone may go before it could feel anything; 0: not known */
    struct vector placed;      /* where the space last had that body */
    struct munk_place *places; /* one for each body */
    struct munk_cone *cones;   /* WORLD_CONES for each body */
    struct munk_loan *loans;   /* MUNK_LOANS in all, and MUNK_LOANS_EACH for each body */
    size_t loan_count;
};

enum { MUNK_LOANS = 2, MUNK_LOANS_EACH = 2 * WORLD_CONES };

void munk_space_borrow(struct munk_world *space, struct world *world);
        /* Becomes the world's space: takes over the collision handlers. */

void munk_space_return(struct munk_world *space);
        /* Gives them back, as they were. */

#endif
