/* body.h: moves a body: its wheels roll it along an arc, and obstacles push it out. */
#ifndef OCTET_WORLD_BODY_H
#define OCTET_WORLD_BODY_H

#include "host_sim/world/native/world.h"

void body_face(struct body *body);
        /* Updates the fields derived from the heading. */

void body_roll(struct body *body, double left_mm, double right_mm, double track_mm);
        /* Rolls each wheel its distance at a constant speed. If the left wheel rolls farther, the body turns right,
           the positive direction. */

void body_place(struct world *world, struct body *body);
        /* Updates what the body overlaps at its pose. */

void body_push_out(struct world *world, struct body *body, struct vector before);
        /* Repeatedly pushes a body out of its deepest overlap; a wedged body returns to where it was before. */

#endif
