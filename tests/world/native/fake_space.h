/* fake_space.h: a space whose answers a test sets, and which records its calls. */
#ifndef FAKE_SPACE_H
#define FAKE_SPACE_H

#include "host_sim/world/native/world.h"

enum { FAKE_STEPS = 16 };

struct fake {
    double depths[FAKE_STEPS];   /* of body 0 after each placing in turn; 0 after the last */
    struct vector normal;        /* of these overlaps */
    size_t steps;
    struct vector position;      /* where a body was placed last */
    bool hides;                  /* something is in every line of sight */
};

extern struct fake fake;

void fake_open(struct world *world, size_t body_count, size_t food_count);
        /* A world of bodies at (1000, 1000) that face +x, and of food that a test places. */

#endif
