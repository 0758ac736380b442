/* clearance.h: the clearance of a place among obstacles. */
#ifndef OCTET_CLEARANCE_H
#define OCTET_CLEARANCE_H

#include <stdbool.h>
#include <stddef.h>

#include "host_sim/world/native/vector.h"

struct bar {   /* a straight obstacle with round ends: those of its centre line */
    struct vector a;
    struct vector b;
};

struct plant {   /* a round one */
    struct vector at;
    double radius_mm;
};

/* What stands in an arena, and its walls. */
struct obstacles {
    double width_mm;
    double height_mm;
    double bar_radius_mm;
    size_t bar_count;
    size_t plant_count;
    const struct bar *bars;
    const struct plant *plants;
};

double clearance_mm(const struct obstacles *obstacles, struct vector at);
        /* The distance from a place to the nearest obstacle or wall; negative inside an obstacle or beyond a wall. */

bool clearance_suffices(const struct obstacles *obstacles, struct vector at, double room_mm);
        /* Whether that is at least room_mm; the same result, but faster. */

#endif
