/* plain_space.h: a space by plain geometry, of discs and cones among capsules, without other libraries. */
#ifndef OCTET_PLAIN_SPACE_H
#define OCTET_PLAIN_SPACE_H

#include "host_sim/world/native/cones.h"
#include "host_sim/world/native/space/plain_grid.h"
#include "host_sim/world/native/world.h"

/* Where a body was last placed. */
struct plain_place {
    struct vector at;
    bool lifted;
    double free_mm;   /* how far it can go from there without feeling an obstacle; 0: unknown */
};

struct plain_world {
    struct space space;
    double body_radius_mm;
    const struct cones *cones;
    size_t capsule_count;
    struct capsule *capsules;      /* walls and bars */
    struct plain_grid *grid;       /* null: check everything; for at most PLAIN_NEAR_MAX bodies */
    struct plain_place *places;    /* one for each body */
    size_t words;                  /* PLAIN_WORDS(capsule_count + body_count) once it is taken */
    uint64_t *touching;            /* words for each body, and once more: a bit for each thing that it touches */
};

enum { PLAIN_WORD_BITS = 64 };
#define PLAIN_WORDS(things) (((things) + PLAIN_WORD_BITS - 1) / PLAIN_WORD_BITS)

void plain_space_take(struct plain_world *space, struct world *world);
        /* Makes this the world's space. Keeps the bodies' poses; present overlaps do not count as new collisions. */

#endif
