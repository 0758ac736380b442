/* tour.h: the shortest way of a body's centre through some places among obstacles. */
#ifndef OCTET_TOUR_H
#define OCTET_TOUR_H

#include <stdint.h>

#include "host_sim/world/native/clearance.h"
#include "host_sim/world/native/space/capsule.h"

enum {
    TOUR_PLACES_MAX = 9,    /* with the start: more places have too many orders to try each */
    TOUR_THINGS_MAX = 64,   /* bars and plants */
    TOUR_ROUNDS_MAX = TOUR_PLACES_MAX + 2 * TOUR_THINGS_MAX,
    TOUR_SIDES = 2,
    TOUR_RIM = 64           /* directions in which a rim is looked at */
};

/* A circle on which a body's centre goes around the end of a bar, or around a plant; of a place, a point. */
struct tour_round {
    struct vector at;
    double radius_mm;
    uint64_t blocked;   /* bit n: something else is in the way in the direction rim[n] */
};

/* A straight part of a way, from one circle to another, or from or to a place. */
struct tour_tangent {
    struct vector along;   /* one millimetre of it */
    double length_mm;
    double way_mm;         /* of the shortest way with it at its end */
    uint16_t from;         /* twice the number of the circle, and 1 more if it is gone around the other way */
    uint16_t to;
    bool is_new;
};

/* Room to work in. The caller provides the tangents. */
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

double tour_mm(struct tour *tour, const struct obstacles *obstacles, double body_radius_mm, const struct vector places[],
               uint32_t count);
        /* The length of the shortest way from the first place through all the others, in whichever order is best, back to none.
           It consists of tangents and arcs; an arc is taken for free if it is so every 5.6 degrees, an error of 0.15 mm of room.
           Infinite if there is no way, or no room for it. */

#endif
