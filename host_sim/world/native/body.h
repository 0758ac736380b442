/* body.h: how a body moves: its wheels roll it along an arc, and obstacles push it out. */
#ifndef OCTET_WORLD_BODY_H
#define OCTET_WORLD_BODY_H

#include "host_sim/world/native/world.h"

void body_roll(struct body *body, double left_mm, double right_mm, double track_mm);
        /* Each wheel rolls its distance at a constant speed. The left wheel rolling farther turns the body right, which
           is the positive direction. */

void body_place(const struct world *world, struct body *body);
        /* Moves the body's shapes to its pose and finds what they overlap there. */

void body_push_out(const struct world *world, struct body *body, double before_x_mm, double before_y_mm);
        /* Pushes a body out of its deepest overlap, repeatedly; a wedged body goes back to where it was before. */

#endif
