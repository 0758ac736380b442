#include "host_sim/world/native/space/capsule.h"

#include <float.h>

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
