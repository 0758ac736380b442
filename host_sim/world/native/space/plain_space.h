/* plain_space.h: a space by plain geometry: discs and cones among capsules. It needs no other library. */
#ifndef OCTET_PLAIN_SPACE_H
#define OCTET_PLAIN_SPACE_H

#include "host_sim/world/native/cones.h"
#include "host_sim/world/native/space/plain_grid.h"
#include "host_sim/world/native/world.h"

/* Where a body was last placed. */
struct plain_place {
    struct vector at;
    bool lifted;
    double free_mm;   /* how far it may go from there before it could feel an obstacle; 0: not known */
};

struct plain_world {
    struct space space;
    double body_radius_mm;
    const struct cones *cones;
    size_t capsule_count;
    struct capsule *capsules;      /* walls and bars */
    struct plain_grid *grid;       /* null: everything is looked at; for at most PLAIN_NEAR_MAX bodies */
    struct plain_place *places;    /* one for each body */
    size_t words;                  /* PLAIN_WORDS(capsule_count + body_count) once it is taken */
    uint64_t *touching;            /* words for each body, and once more: a bit for each thing that it touches */
};

enum { PLAIN_WORD_BITS = 64 };
#define PLAIN_WORDS(things) (((things) + PLAIN_WORD_BITS - 1) / PLAIN_WORD_BITS)

void plain_space_take(struct plain_world *space, struct world *world);
        /* Becomes the world's space. The bodies are where they are, and what they overlap is not new to them. */

#endif
