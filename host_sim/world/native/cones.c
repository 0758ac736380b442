#include "host_sim/world/native/cones.h"

#include "host_sim/world/native/trig.h"
#include "host_sim/world/native/vector_sums.h"

static const double RAD_PER_DEG = 3.141592653589793 / 180.0;
static const double WIDTH_DEG = 45.0;

enum { ARC_STEPS = 4, FRONT = 2 };

static void set_cone(struct cone *cone, double bearing_deg, double reach_mm)
{
    double step = WIDTH_DEG * RAD_PER_DEG / ARC_STEPS, first = (bearing_deg - WIDTH_DEG / 2) * RAD_PER_DEG;
    /* The corners are as far outside the arc as the midpoints of the edges are inside it. */
    double corner_mm = 2 * reach_mm / (1 + trig_cos(step / 2));

    cone->corners[0] = (struct vector){0.0, 0.0};
    for (unsigned i = 0; i <= ARC_STEPS; i++) {
        double angle = first + step * i;

        cone->corners[i + 1] = (struct vector){corner_mm * trig_cos(angle), corner_mm * trig_sin(angle)};
    }
}

void cones_set(struct cones *cones, double reach_mm, double front_extra_mm)
{
    cones->reach_mm = 0.0;
    for (unsigned n = 0; n < CONES; n++) {
        struct cone *cone = &cones->of[n];
        double far_mm;

        set_cone(cone, WIDTH_DEG * (FRONT - (double)n), n == FRONT ? reach_mm + front_extra_mm : reach_mm);
        far_mm = vector_length(cone->corners[1]);
        if (far_mm > cones->reach_mm)
            cones->reach_mm = far_mm;
    }
}

static bool is_close(const struct capsule *thing, struct vector point)
{
    struct vector line = vector_to(thing->a, thing->b), way = vector_to(thing->a, point);
    double along = vector_dot(way, line), square = vector_dot(line, line), aside = vector_cross(line, way);
    double limit = thing->radius_mm * thing->radius_mm;

    if (along > 0.0 && along < square)
        return aside * aside <= limit * square;
    if (along > 0.0)
        way = vector_to(thing->b, point);
    return vector_dot(way, way) <= limit;
}

/* Whether all corners are on the same side of an obstacle's centre line, farther away than its radius. */
static bool is_aside(const struct cone *cone, const struct capsule *thing)
{
    struct vector way = vector_to(thing->a, thing->b);
    double limit = thing->radius_mm * thing->radius_mm * vector_dot(way, way);
    unsigned left = 0, right = 0;

    for (unsigned i = 0; i < CONE_CORNERS; i++) {
        double aside = vector_cross(way, vector_to(thing->a, cone->corners[i]));

        if (aside * aside <= limit)
            return false;
        left += aside < 0.0;
        right += aside > 0.0;
    }
    return left == 0 || right == 0;
}

/* Whether an end of an obstacle is within its radius of an edge. */
static bool touches_edge(const struct cone *cone, const struct capsule *thing)
{
    for (unsigned i = 0; i < CONE_CORNERS; i++) {
        struct capsule edge = {.a = cone->corners[i], .b = cone->corners[(i + 1) % CONE_CORNERS],
            .radius_mm = thing->radius_mm};

        if (is_close(&edge, thing->a) || is_close(&edge, thing->b))
            return true;
    }
    return false;
}

/* Whether part of an obstacle's centre line is inside: clips it at each edge in turn. */
static bool passes_through(const struct cone *cone, const struct capsule *thing)
{
    double begins = 0.0, ends = 1.0;

    for (unsigned i = 0; i < CONE_CORNERS; i++) {
        struct vector edge = vector_to(cone->corners[i], cone->corners[(i + 1) % CONE_CORNERS]);
        double a = vector_cross(edge, vector_to(cone->corners[i], thing->a));
        double b = vector_cross(edge, vector_to(cone->corners[i], thing->b));

        if (a < 0.0 && b < 0.0)
            return false;
        if (a < 0.0 && a / (a - b) > begins)
            begins = a / (a - b);
        if (b < 0.0 && a / (a - b) < ends)
            ends = a / (a - b);
    }
    return begins <= ends;
}

bool cones_overlap(const struct cone *cone, const struct capsule *thing)
{
    if (is_aside(cone, thing))
        return false;
    for (unsigned i = 0; i < CONE_CORNERS; i++)
        if (is_close(thing, cone->corners[i]))
            return true;
    return touches_edge(cone, thing) || passes_through(cone, thing);
}
