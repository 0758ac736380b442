#include "host_sim/world/native/body.h"

#include "host_sim/world/native/trig.h"

static const double TAU = 6.283185307179586476925286766559;
/* How deep a body that is pushed out stays in the obstacle, so that it keeps touching and does not bounce. */
static const double TOUCH_MM = 0.01;

enum { PUSHES = 8 };

void body_face(struct body *body)
{
    body->ahead_rad = body->heading_rad;
    body->ahead = trig_along(body->heading_rad);
}

/* Wraps an angle to -pi..pi. Up to 3 pi the result equals that of remainder() to the last bit. */
static double within_half_a_turn(double angle_rad)
{
    while (angle_rad > TAU / 2)
        angle_rad -= TAU;
    while (angle_rad < -TAU / 2)
        angle_rad += TAU;
    return angle_rad;
}

void body_roll(struct body *body, double left_mm, double right_mm, double track_mm)
{
    double turn = (left_mm - right_mm) / track_mm, way_mm = (left_mm + right_mm) / 2;
    double half = turn / 2, square = half * half;
    /* Taylor series of sin(x)/x and cos(x), for angles that a body can turn in a tick. */
    double part = 1.0 + square * (-1.0 / 6 + square * (1.0 / 120 + square * (-1.0 / 5040 + square * (1.0 / 362880))));
    double cosine = 1.0 + square * (-1.0 / 2 + square * (1.0 / 24 + square * (-1.0 / 720 + square * (1.0 / 40320))));
    double sine = half * part, chord_mm = way_mm * part;
    struct vector along = {body->ahead.x * cosine - body->ahead.y * sine,
                           body->ahead.y * cosine + body->ahead.x * sine};

    body->x_mm += chord_mm * along.x;
    body->y_mm += chord_mm * along.y;
    body->heading_rad = within_half_a_turn(body->heading_rad + turn);
    if (body->heading_rad != body->ahead_rad)
        body_face(body);
}

void body_place(struct world *world, struct body *body)
{
    body->depth_mm = 0.0;
    world->space->place(world, body);
}

void body_push_out(struct world *world, struct body *body, struct vector before)
{
    for (unsigned i = 0; i < PUSHES && body->depth_mm > TOUCH_MM; i++) {
        double push_mm = body->depth_mm - TOUCH_MM / 2;

        body->x_mm -= push_mm * body->normal.x;
        body->y_mm -= push_mm * body->normal.y;
        body_place(world, body);
    }
    if (body->depth_mm > TOUCH_MM) {
        body->x_mm = before.x;
        body->y_mm = before.y;
        body_place(world, body);
    }
}
