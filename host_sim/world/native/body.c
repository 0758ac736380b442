#include "host_sim/world/native/body.h"

#include <math.h>

static const double TAU = 6.283185307179586476925286766559;
/* A pushed-out body stays this deep in the obstacle, so that it goes on touching and does not bounce. */
static const double TOUCH_MM = 0.01;

enum { PUSHES = 8 };

void body_roll(struct body *body, double left_mm, double right_mm, double track_mm)
{
    double turn = (left_mm - right_mm) / track_mm, way_mm = (left_mm + right_mm) / 2;
    double half = turn / 2;
    double chord_mm = half == 0.0 ? way_mm : way_mm * sin(half) / half;

    body->x_mm += chord_mm * cos(body->heading_rad + half);
    body->y_mm += chord_mm * sin(body->heading_rad + half);
    body->heading_rad = remainder(body->heading_rad + turn, TAU);
}

void body_place(const struct world *world, struct body *body)
{
    struct munk_vector at = {body->x_mm, body->y_mm};

    body->depth_mm = 0.0;
    world->munk->cpBodySetPosition(body->in_space, body->lifted ? body->in_the_air : at);
    world->munk->cpBodySetAngle(body->in_space, body->heading_rad);
    world->munk->cpSpaceStep(world->space, world->params.tick_s);
}

void body_push_out(const struct world *world, struct body *body, double before_x_mm, double before_y_mm)
{
    for (unsigned i = 0; i < PUSHES && body->depth_mm > TOUCH_MM; i++) {
        double push_mm = body->depth_mm - TOUCH_MM / 2;

        body->x_mm -= push_mm * body->normal.x;
        body->y_mm -= push_mm * body->normal.y;
        body_place(world, body);
    }
    if (body->depth_mm > TOUCH_MM) {
        body->x_mm = before_x_mm;
        body->y_mm = before_y_mm;
        body_place(world, body);
    }
}
