/* space.h: the world's interface to geometry: plain_space.h, or pymunk through host_sim/world/munk_space.py. Their
 * results are equal, bit for bit. */
#ifndef OCTET_SPACE_H
#define OCTET_SPACE_H

#include <stdbool.h>

#include "host_sim/world/native/vector.h"

struct world;
struct body;

/* The first member of every space. */
struct space {
    void (*place)(struct world *world, struct body *body);
            /* Finds what a body and its cones overlap at its pose, and how that affects other bodies. Sets overlaps,
               feel and touches, counts collisions, and stores the deepest overlap in depth_mm and normal. */
    bool (*hides)(const struct world *world, const struct body *body, struct vector point);
            /* Whether an obstacle or another body is between a body and a point. */
};

#endif
