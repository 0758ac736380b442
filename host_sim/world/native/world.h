/* world.h: an arena: what the bodies sense and eat, and how they move, one control tick at a time. The caller
 * provides all memory, and must not move it. */
#ifndef OCTET_WORLD_H
#define OCTET_WORLD_H

#include <stddef.h>

#include "firmware/io.h"
#include "host_sim/world/native/body_faults.h"
#include "host_sim/world/native/space/space.h"

enum { WORLD_CONES = 5 };   /* of a body; cone n sets bit n of feel */

struct kit;   /* kit.h */

/* Dimensions, as in SimParams. */
struct world_params {
    double wheel_track_mm;
    double beam_width_mm;
    double eat_reach_mm;
    double tick_s;
    double max_wheel_speed_mm_s;
};

struct food {
    double x_mm;
    double y_mm;
    bool eaten;
};

struct body {
    /* State; body.py reads the first five: */
    double x_mm;
    double y_mm;
    double heading_rad;
    double left_mm;               /* counted by the odometers so far */
    double right_mm;
    double depth_mm;              /* depth of its deepest overlap since it was placed, */
    struct vector normal;         /* and its direction, out of the body */
    int32_t seen;                 /* the food last sensed straight ahead; -1: none */
    int32_t seen_mm;
    int32_t touches;              /* things that it touches now */
    int32_t collisions;           /* times that it has begun to touch something */
    int32_t overlaps[WORLD_CONES];   /* things in each cone */
    uint8_t feel;
    bool lifted;                  /* a person holds it in the air */
    /* Derived from its heading: */
    double ahead_rad;             /* the heading of */
    struct vector ahead;          /* one millimetre straight ahead */
    struct body_faults faults;
    struct kit *kit;              /* what makes it a real body; null: it is ideal */
};

struct world {
    struct space *space;
    struct world_params params;
    size_t body_count;
    size_t food_count;
    struct body *bodies;
    struct food *food;
};

struct ranges;

void world_begin(struct world *world);
        /* Call after setting the bodies' poses from outside. */

void world_settle(struct world *world);
        /* The same if the space has the poses already: finds what the bodies overlap now. */

void world_sense(struct world *world, struct body *body, uint32_t tick, struct senses *out);
        /* What the robot is told of its body's senses at its pose. tick is the number of the tick in the run. */

void world_measure(struct world *world, struct body *body, uint32_t tick, const struct ranges *ideal,
                   uint8_t *range_mm);
        /* The distances that a robot is told in that tick, FEEL_COUNT of them as in struct senses. ideal: what an
           ideal body measures; a real one has sensors of its own. */

bool world_eat(struct world *world, struct body *body);
        /* Eats the food that was last sensed straight ahead, if it is near enough and still there. */

double world_way_mm(const struct world *world, double speed_mm_s);
        /* How far a wheel rolls in one control tick. */

void world_move(struct world *world, struct body *body, double left_mm_s, double right_mm_s);
        /* Drives the wheels as the robot commands, for one control tick. */

size_t world_food_left(const struct world *world);
        /* Number of pieces that have not been eaten. */

/* Moves a body: its wheels roll it along an arc, and obstacles push it out. */

void body_face(struct body *body);
        /* Updates the fields derived from the heading. */

void body_roll(struct body *body, double left_mm, double right_mm, double track_mm);
        /* Rolls each wheel its distance at a constant speed. If the left wheel rolls farther, the body turns right,
           the positive direction. */

void body_place(struct world *world, struct body *body);
        /* Updates what the body overlaps at its pose. */

void body_push_out(struct world *world, struct body *body, struct vector before);
        /* Repeatedly pushes a body out of its deepest overlap; a wedged body returns to where it was before. */

/* The beam that sees food straight ahead. */

void sight_look(const struct world *world, struct body *body);
        /* Finds the nearest visible food in the beam straight ahead, and its distance: 1 mm or more, or 0 if there is
           none. A lifted body sees nothing. */

#endif
