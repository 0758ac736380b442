#include "host_sim/world/native/space/capsule.h"

#include <float.h>

#include "host_sim/world/native/trig.h"
#include "host_sim/world/native/vector_sums.h"

static const double WALL_MM = 100.0;   /* half the walls' thickness */

static double less(double one, double other)
{
    return one < other ? one : other;
}

static double more(double one, double other)
{
    return one > other ? one : other;
}

static double clamped(double part)
{
    return more(0.0, less(part, 1.0));
}

void capsule_set(struct capsule *capsule, struct vector a, struct vector b, double radius_mm)
{
    struct vector way = vector_to(a, b);
    struct vector unit = vector_scale(way, 1.0 / (vector_length(way) + DBL_MIN));

    capsule->a = a;
    capsule->b = b;
    capsule->radius_mm = radius_mm;
    capsule->side = (struct vector){unit.y, -unit.x};
    capsule->low = (struct vector){less(a.x, b.x) - radius_mm, less(a.y, b.y) - radius_mm};
    capsule->high = (struct vector){more(a.x, b.x) + radius_mm, more(a.y, b.y) + radius_mm};
}

void capsule_set_walls(struct capsule walls[WALLS], double width_mm, double height_mm)
{
    double right = width_mm + WALL_MM, bottom = height_mm + WALL_MM;
    const struct vector corners[] = {{-WALL_MM, -WALL_MM}, {right, -WALL_MM}, {right, bottom}, {-WALL_MM, bottom}};

    for (unsigned i = 0; i < WALLS; i++)
        capsule_set(&walls[i], corners[i], corners[(i + 1) % WALLS], WALL_MM);
}

double capsule_apart_mm(const struct capsule *capsule, struct vector point)
{
    double across_mm = more(capsule->low.x - point.x, point.x - capsule->high.x);
    double down_mm = more(capsule->low.y - point.y, point.y - capsule->high.y);

    return more(across_mm, down_mm);
}

/* The point of a centre line that is nearest to a point. */
static struct vector nearest_of(struct vector a, struct vector b, struct vector point)
{
    struct vector way = vector_to(a, b);
    double part = clamped(vector_dot(way, vector_to(a, point)) / vector_dot(way, way));

    return vector_add(a, vector_scale(way, part));
}

struct vector capsule_nearest(const struct capsule *capsule, struct vector point)
{
    return nearest_of(capsule->a, capsule->b, point);
}

/* A disc that touches another: the nearest one of a capsule, or a body's. Contact points are relative to `middle`. */
struct disc {
    struct vector centre;
    double radius_mm;
    struct vector middle;
};

static struct vector rim(const struct disc *disc, struct vector normal, double radius_mm)
{
    struct vector point = vector_add(disc->centre, vector_scale(normal, radius_mm));

    return vector_add(disc->middle, vector_to(disc->middle, point));
}

static void meet(const struct disc *disc, const struct disc *other, struct vector side, struct contact *out)
{
    struct vector way = vector_to(disc->centre, other->centre);
    double reach_mm = disc->radius_mm + other->radius_mm, length_mm;

    out->apart_mm2 = vector_dot(way, way);
    out->touches = out->apart_mm2 < reach_mm * reach_mm;
    if (!out->touches)
        return;
    length_mm = vector_length(way);
    out->normal = length_mm != 0.0 ? vector_scale(way, 1.0 / length_mm) : side;
    way = vector_to(rim(disc, out->normal, disc->radius_mm), rim(other, out->normal, -other->radius_mm));
    out->depth_mm = -vector_dot(way, out->normal);
}

void capsule_meet_disc(const struct capsule *capsule, struct vector centre, double radius_mm, struct contact *out)
{
    const struct disc disc = {centre, radius_mm, centre};
    const struct disc nearest = {nearest_of(capsule->a, capsule->b, centre), capsule->radius_mm, {0.0, 0.0}};

    meet(&disc, &nearest, capsule->side, out);
}

void capsule_meet_discs(struct vector one, struct vector other, double radius_mm, struct contact *out)
{
    const struct disc first = {one, radius_mm, one}, second = {other, radius_mm, other};
    static const struct vector to_the_right = {1.0, 0.0};

    meet(&first, &second, to_the_right, out);
}

static bool is_inside(struct vector a, struct vector b, double radius_mm, struct vector point)
{
    /* Measured from b, as in Munk2D. */
    return vector_length(vector_to(nearest_of(b, a, point), point)) - radius_mm <= 0.0;
}

/* Whether a straight path from outside a disc enters it. */
static bool enters_disc(struct vector centre, double radius_mm, struct vector from, struct vector to)
{
    struct vector start = vector_to(centre, from), end = vector_to(centre, to);
    double start2 = vector_dot(start, start), both = vector_dot(start, end);
    double a = start2 - 2.0 * both + vector_dot(end, end), b = both - start2;
    double square = b * b - a * (start2 - radius_mm * radius_mm), part;

    if (!(square >= 0.0))
        return false;
    part = (-b - vector_root(square)) / a;
    return part >= 0.0 && part < 1.0;
}

/* Whether a straight path from outside enters the capsule through one of its long sides. */
static bool crosses_side(double from_line_mm, double radius_mm, double along_side)
{
    double before = from_line_mm > 0.0 ? radius_mm - from_line_mm : -radius_mm - from_line_mm;
    double after = along_side + before;

    return before * after < 0.0 && before / (before - after) < 1.0;
}

static bool is_disc(const struct capsule *capsule)
{
    return capsule->side.x == 0.0 && capsule->side.y == 0.0;
}

static bool goes_into(const struct capsule *capsule, struct vector from, struct vector to)
{
    struct vector way = vector_to(from, to), side = capsule->side;
    double line_mm = vector_dot(vector_to(from, capsule->a), side), radius_mm = capsule->radius_mm;
    struct vector facing = line_mm > 0.0 ? vector_scale(side, -1.0) : side;
    struct vector shift = vector_to(from, vector_scale(facing, radius_mm));
    struct vector a = vector_add(capsule->a, shift), b = vector_add(capsule->b, shift);

    if (!is_disc(capsule) && vector_cross(way, a) * vector_cross(way, b) <= 0.0)
        return crosses_side(line_mm, radius_mm, vector_dot(way, side));
    return enters_disc(capsule->a, radius_mm, from, to) || enters_disc(capsule->b, radius_mm, from, to);
}

/* Whether a straight path misses the bounding box of a capsule on one side. */
static bool is_aside(const struct capsule *capsule, struct vector from, struct vector to)
{
    return (from.x < capsule->low.x && to.x < capsule->low.x) || (from.x > capsule->high.x && to.x > capsule->high.x)
        || (from.y < capsule->low.y && to.y < capsule->low.y) || (from.y > capsule->high.y && to.y > capsule->high.y);
}

bool capsule_hides(const struct capsule *capsule, struct vector from, struct vector to)
{
    if (is_aside(capsule, from, to))
        return false;
    return is_inside(capsule->a, capsule->b, capsule->radius_mm, from) || goes_into(capsule, from, to);
}

bool capsule_disc_hides(struct vector centre, double radius_mm, struct vector from, struct vector to)
{
    return vector_length(vector_to(centre, from)) - radius_mm <= 0.0 || enters_disc(centre, radius_mm, from, to);
}

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
static bool is_outside(const struct cone *cone, const struct capsule *thing)
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
    if (is_outside(cone, thing))
        return false;
    for (unsigned i = 0; i < CONE_CORNERS; i++)
        if (is_close(thing, cone->corners[i]))
            return true;
    return touches_edge(cone, thing) || passes_through(cone, thing);
}
