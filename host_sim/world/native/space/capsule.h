/* capsule.h: a straight thing with round ends: a bar or a wall, or a disc, whose ends are the same. It computes as
 * Munk2D does, in the same order, so that the results are equal to the last bit. */
#ifndef OCTET_CAPSULE_H
#define OCTET_CAPSULE_H

#include <stdbool.h>

#include "host_sim/world/native/vector.h"

struct capsule {
    struct vector a;      /* ends of its centre line */
    struct vector b;
    double radius_mm;
    struct vector side;   /* unit normal of the centre line; 0 for a disc */
    struct vector low;    /* corners of its bounding box */
    struct vector high;
};

/* The position of a disc relative to a capsule. */
struct contact {
    double apart_mm2;       /* square of the distance from the disc's centre to the centre line */
    bool touches;           /* if so: */
    double depth_mm;        /* of the overlap */
    struct vector normal;   /* from the disc into the capsule */
};

enum { WALLS = 4 };

void capsule_set(struct capsule *capsule, struct vector a, struct vector b, double radius_mm);
        /* Fills in a capsule from its ends. */

void capsule_set_walls(struct capsule walls[WALLS], double width_mm, double height_mm);
        /* The walls around an arena with a corner at (0, 0); their insides are its edge. */

double capsule_apart_mm(const struct capsule *capsule, struct vector point);
        /* A lower bound of its distance from a point: that of its bounding box, negative within the box. */

struct vector capsule_nearest(const struct capsule *capsule, struct vector point);
        /* The point of its centre line that is nearest to a point. */

void capsule_meet_disc(const struct capsule *capsule, struct vector centre, double radius_mm, struct contact *out);
        /* The position of a disc relative to it. */

void capsule_meet_discs(struct vector one, struct vector other, double radius_mm, struct contact *out);
        /* The same for two discs of one size; the normal is from the first one into the other. */

bool capsule_hides(const struct capsule *capsule, struct vector from, struct vector to);
        /* Whether it crosses the straight line between two points. */

bool capsule_disc_hides(struct vector centre, double radius_mm, struct vector from, struct vector to);
        /* The same for a disc. */

/* The five proximity cones around the front of a body. host_sim/world/native_world.py makes pymunk's. */

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
