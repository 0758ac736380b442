/* cones.h: the five proximity cones around the front of a body. host_sim/world/cones.py makes pymunk's. */
#ifndef OCTET_CONES_H
#define OCTET_CONES_H

#include "host_sim/world/native/space/capsule.h"

enum { CONES = 5, CONE_CORNERS = 6 };

/* The outline of a cone, in the frame of a body that faces +x: its tip is the body's centre. */
struct cone {
    struct vector corners[CONE_CORNERS];
};

struct cones {
    struct cone of[CONES];   /* cone n sets bit n of feel */
    double reach_mm;         /* distance of the farthest corner from the centre */
};

void cones_set(struct cones *cones, double reach_mm, double front_extra_mm);
        /* Lays out the cones. They reach reach_mm from the body's centre, the front one front_extra_mm farther. */

bool cones_overlap(const struct cone *cone, const struct capsule *thing);
        /* Whether a thing, in the body's frame, is at least partly within a cone. */

#endif
