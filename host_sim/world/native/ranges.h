/* ranges.h: exact distances to what the proximity cones see, for robots that ask for distances. */
#ifndef OCTET_RANGES_H
#define OCTET_RANGES_H

#include "host_sim/world/native/space/capsule.h"
#include "host_sim/world/native/world.h"

/* What is measured. */
struct ranges {
    const struct capsule *capsules;   /* walls, bars and plants */
    size_t capsule_count;
    double body_radius_mm;
    double reach_mm;          /* of the cones, from the centre of a body, */
    double front_extra_mm;    /* and how much farther the front one reaches */
    double cone_deg;          /* width of a cone; 0: 45, seamless */
};

void ranges_measure(const struct ranges *ranges, const struct world *world, const struct body *body,
                    uint8_t *range_mm);
        /* Distances from a body to capsules and other bodies: for each of the FEEL_COUNT cones, whole mm beyond its
           rim, or RANGE_NONE if nothing is in range, as for a lifted body. */

#endif
