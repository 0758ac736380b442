/* fake_munk.h: a space that answers as a test says, and notes what it is told. */
#ifndef FAKE_MUNK_H
#define FAKE_MUNK_H

#include "host_sim/world/native/munk_space.h"

enum { FAKE_HANDLERS = 64, FAKE_STEPS = 16 };

struct fake_munk {
    struct munk_handler handlers[FAKE_HANDLERS];
    size_t handler_count;
    struct munk_shape *shapes[2];      /* of every arbiter */
    struct munk_contacts contacts;     /* of every arbiter */
    double depths[FAKE_STEPS];         /* that body 0 has after each step, one after the other; 0 after the last */
    struct vector normal;              /* of these overlaps */
    size_t steps;
    double step_s;
    struct munk_vector position;       /* last set */
    double angle;
    bool hides;                        /* something is in every line of sight */
    struct munk_filter sight;          /* of the last query */
    double nearest_mm;                 /* how far away the nearest obstacle is */
};

extern struct fake_munk fake;

extern struct munk_world fake_space;

void fake_open(struct world *world, size_t body_count, size_t food_count);
        /* A world of bodies at (1000, 1000) that face +x, and of food that a test places. fake_space is its space. */

struct munk_handler *fake_handler(uintptr_t type_a, uintptr_t type_b);
        /* The handler of a pair; null if nobody asked for it. */

struct munk_shape *fake_disc(size_t body);
        /* A body's disc. */

#endif
