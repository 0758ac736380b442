/* body.h: how a body moves: its wheels roll it along an arc, and obstacles push it out. */
#ifndef OCTET_WORLD_BODY_H
#define OCTET_WORLD_BODY_H

#include "host_sim/world/native/world.h"

void body_face(struct body *body);
        /* Brings up to date what follows from the heading. */

void body_roll(struct body *body, double left_mm, double right_mm, double track_mm);
        /* Each wheel rolls its distance at a constant speed. The left wheel rolling farther turns the body right, which
           is the positive direction. */

void body_place(struct world *world, struct body *body);
        /* Finds what the body overlaps at its pose. */

void body_push_out(struct world *world, struct body *body, struct vector before);
        /* Pushes a body out of its deepest overlap, repeatedly; a wedged body goes back to where it was before. */

#endif
