/* tour.h: the shortest path of a body's centre through some places among obstacles. */
#ifndef OCTET_TOUR_H
#define OCTET_TOUR_H

#include <stdint.h>

#include "host_sim/world/native/draw/layout.h"
#include "host_sim/world/native/space/capsule.h"

enum {
    TOUR_PLACES_MAX = 9,    /* with the start: more have too many orders to try them all */
    TOUR_THINGS_MAX = 64,   /* bars and plants */
    TOUR_ROUNDS_MAX = TOUR_PLACES_MAX + 2 * TOUR_THINGS_MAX,
    TOUR_SIDES = 2,
    TOUR_RIM = 64           /* directions in which a rim is checked */
};

/* A circle on which a body's centre goes around the end of a bar or a plant; for a place, a point. */
struct tour_round {
    struct vector at;
    double radius_mm;
    uint64_t blocked;   /* bit n: direction rim[n] is blocked by another obstacle */
};

/* A straight part of a path, from one circle to another, or from or to a place. */
struct tour_tangent {
    struct vector along;   /* one millimetre of it */
    double length_mm;
    double way_mm;         /* length of the shortest path that ends with it */
    uint16_t from;         /* twice the number of the circle, and 1 more if it is gone around the other way */
    uint16_t to;
    bool is_new;
};

/* Working memory. The caller provides the tangents. */
struct tour {
    struct tour_tangent *tangents;
    uint32_t tangents_max;
    uint32_t tangent_count;
    uint32_t first[TOUR_SIDES * TOUR_ROUNDS_MAX + 1];   /* tangent from each side of a circle */
    uint32_t round_count;
    struct tour_round rounds[TOUR_ROUNDS_MAX];          /* the places are the first ones */
    struct vector rim[TOUR_RIM];
    uint32_t thing_count;
    struct capsule things[TOUR_THINGS_MAX];             /* where the centre cannot be */
    struct vector low;                                  /* corners of where the walls let it be */
    struct vector high;
};

double tour_mm(struct tour *tour, const struct obstacles *obstacles, double body_radius_mm,
               const struct vector places[], uint32_t count);
        /* The length of the shortest open path from the first place through all others, in the best order. It
           consists of tangents and arcs; an arc counts as free if it is free every 5.6 degrees, an error of 0.15 mm
           in clearance. Infinite if there is no path, or not enough working memory. */

#endif
