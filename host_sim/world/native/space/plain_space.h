/* plain_space.h: a space by plain geometry, of discs and cones among capsules, without other libraries. */
#ifndef OCTET_PLAIN_SPACE_H
#define OCTET_PLAIN_SPACE_H

#include <stddef.h>
#include <stdint.h>

#include "host_sim/world/native/space/capsule.h"
#include "host_sim/world/native/vector.h"
#include "host_sim/world/native/world.h"

/* A grid that finds capsules and bodies near a place, for worlds with many bodies. */

enum { PLAIN_NEAR_MAX = 256 };   /* bodies in nine cells; not half as many fit */

struct plain_grid {
    double cell_mm;            /* more than from the middle of a body to that of another one which it feels */
    uint32_t columns;
    uint32_t rows;
    const uint32_t *firsts;    /* by cell, row by row, where its capsules begin in numbers; and where the last end */
    const uint32_t *numbers;   /* of the capsules that can be felt from within a cell */
    uint32_t *heads;           /* for each cell, one more than the number of a body in it; 0: none */
    uint32_t *nexts;           /* the same for each body: the next one in its cell */
    uint32_t *cells;           /* for each body, one more than its cell; 0: none */
};

uint32_t plain_grid_cell(const struct plain_grid *grid, struct vector at);
        /* The cell of a place; the nearest one for a place outside. */

double plain_grid_border_mm(const struct plain_grid *grid, struct vector at);
        /* Minimum distance to another cell. */

void plain_grid_put(struct plain_grid *grid, uint32_t body, struct vector at);
        /* Moves a body from its cell to that of a place. */

size_t plain_grid_near(const struct plain_grid *grid, struct vector at, uint32_t bodies[PLAIN_NEAR_MAX]);
        /* The bodies in the cell of a place and in those around it. */

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
