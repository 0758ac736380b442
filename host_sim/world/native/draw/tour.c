#include "host_sim/world/native/draw/tour.h"

#include <math.h>

#include "host_sim/world/native/trig.h"
#include "host_sim/world/native/vector_sums.h"

static const double DOUBT_MM = 1e-6;   /* a path may touch an obstacle: far above rounding errors */
static const double DOUBT = 1e-9;      /* of a sine */
static const double HALF_TURN_RAD = 3.14159265358979323846;

static struct vector left_of(struct vector way)
{
    return (struct vector){-way.y, way.x};
}

/* 1 if a path turns left around a circle, else -1. */
static double sign_of(uint32_t side)
{
    return side % TOUR_SIDES ? -1.0 : 1.0;
}

static bool is_inside_walls(const struct tour *tour, struct vector at)
{
    return at.x >= tour->low.x && at.x <= tour->high.x && at.y >= tour->low.y && at.y <= tour->high.y;
}

static bool is_far(const struct capsule *capsule, struct vector at, double apart_mm)
{
    struct vector way = vector_to(capsule_nearest(capsule, at), at);

    return vector_dot(way, way) >= apart_mm * apart_mm;
}

static bool is_across(const struct capsule *line, struct vector from, struct vector to)
{
    struct vector along = vector_to(line->a, line->b);

    return vector_cross(along, vector_to(line->a, from)) * vector_cross(along, vector_to(line->a, to)) < 0.0;
}

static bool cross(const struct capsule *one, const struct capsule *other)
{
    return is_across(one, other->a, other->b) && is_across(other, one->a, one->b);
}

/* Whether a segment, a capsule of no width, misses an obstacle. Segments that do not cross are nearest at an end. */
static bool is_clear(const struct capsule *thing, const struct capsule *way)
{
    double apart_mm = thing->radius_mm;

    return is_far(thing, way->a, apart_mm) && is_far(thing, way->b, apart_mm) && is_far(way, thing->a, apart_mm)
        && is_far(way, thing->b, apart_mm) && !cross(thing, way);
}

static bool is_free(const struct tour *tour, struct vector from, struct vector to)
{
    struct capsule way;

    if (!is_inside_walls(tour, from) || !is_inside_walls(tour, to))
        return false;
    capsule_set(&way, from, to, 0.0);
    for (uint32_t i = 0; i < tour->thing_count; i++)
        if (!is_clear(&tour->things[i], &way))
            return false;
    return true;
}

static void add_round(struct tour *tour, struct vector at, double radius_mm)
{
    struct tour_round *round = &tour->rounds[tour->round_count++];

    *round = (struct tour_round){at, radius_mm, 0};
    for (unsigned i = 0; i < TOUR_RIM && radius_mm > 0.0; i++) {
        struct vector point = vector_add(at, vector_scale(tour->rim[i], radius_mm));

        if (!is_free(tour, point, point))
            round->blocked |= (uint64_t)1 << i;
    }
}

/* Adds the straight path from one side of a circle to one of another, if nothing is in its way. */
static void add_tangent(struct tour *tour, uint32_t from, uint32_t to)
{
    const struct tour_round *one = &tour->rounds[from / TOUR_SIDES], *other = &tour->rounds[to / TOUR_SIDES];
    double out_mm = sign_of(from) * one->radius_mm, in_mm = sign_of(to) * other->radius_mm;
    double across_mm = in_mm - out_mm;
    struct vector way = vector_to(one->at, other->at), along, left;
    double square = vector_dot(way, way), length_mm = vector_root(square - across_mm * across_mm);

    if (!(length_mm > 0.0) || tour->tangent_count == tour->tangents_max)
        return;
    along = vector_scale(vector_add(vector_scale(way, length_mm), vector_scale(left_of(way), -across_mm)),
                         1.0 / square);
    left = left_of(along);
    if (is_free(tour, vector_add(one->at, vector_scale(left, -out_mm)),
                vector_add(other->at, vector_scale(left, -in_mm))))
        tour->tangents[tour->tangent_count++] =
            (struct tour_tangent){.along = along, .length_mm = length_mm, .from = (uint16_t)from, .to = (uint16_t)to};
}

/* Whether there is such a side: a point has only one. */
static bool is_there(const struct tour *tour, uint32_t side)
{
    return side % TOUR_SIDES == 0 || tour->rounds[side / TOUR_SIDES].radius_mm > 0.0;
}

static void add_tangents(struct tour *tour)
{
    uint32_t sides = TOUR_SIDES * tour->round_count;

    tour->tangent_count = 0;
    for (uint32_t from = 0; from < sides; from++) {
        tour->first[from] = tour->tangent_count;
        for (uint32_t to = 0; to < sides && is_there(tour, from); to++)
            if (to / TOUR_SIDES != from / TOUR_SIDES && is_there(tour, to))
                add_tangent(tour, from, to);
    }
    tour->first[sides] = tour->tangent_count;
}

/* The angle with this cosine and sine, 0..pi, by Newton's method; accurate to a few ulp. */
static double angle_rad(double cosine, double sine)
{
    double angle = HALF_TURN_RAD / 2.0 * (1.0 - cosine);

    for (unsigned i = 0; i < 3; i++) {
        struct vector along = trig_along(angle);

        angle += sine * along.x - cosine * along.y;
    }
    return angle;
}

static bool is_arc_free(const struct tour *tour, const struct tour_tangent *in, const struct tour_tangent *out)
{
    uint64_t blocked = tour->rounds[in->to / TOUR_SIDES].blocked;
    double sign = sign_of(in->to);

    /* A blocked point of the rim is on the arc if the direction of travel there is between the tangents. */
    for (unsigned i = 0; i < TOUR_RIM && blocked; i++, blocked >>= 1) {
        struct vector along = vector_scale(left_of(tour->rim[i]), sign);

        if (blocked & 1 && sign * vector_cross(in->along, along) >= 0.0
            && sign * vector_cross(along, out->along) >= 0.0)
            return false;
    }
    return true;
}

/* The length of the arc between two tangents; infinite for more than half a turn, which no shortest path has. */
static double arc_mm(const struct tour *tour, const struct tour_tangent *in, const struct tour_tangent *out)
{
    double cosine = vector_dot(in->along, out->along), sine = sign_of(in->to) * vector_cross(in->along, out->along);
    double radius_mm = tour->rounds[in->to / TOUR_SIDES].radius_mm;

    if (radius_mm == 0.0 || (fabs(sine) < DOUBT && cosine > 0.0))
        return 0.0;
    return sine > 0.0 && is_arc_free(tour, in, out) ? radius_mm * angle_rad(cosine, sine) : HUGE_VAL;
}

/* Continues from the end of a tangent. Returns whether that makes a path shorter. */
static bool go_on(struct tour *tour, const struct tour_tangent *in)
{
    bool is_shorter = false;

    for (uint32_t i = tour->first[in->to]; i < tour->first[in->to + 1]; i++) {
        struct tour_tangent *out = &tour->tangents[i];
        double way_mm = in->way_mm + out->length_mm;

        if (way_mm < out->way_mm && (way_mm += arc_mm(tour, in, out)) < out->way_mm) {
            out->way_mm = way_mm;
            out->is_new = is_shorter = true;
        }
    }
    return is_shorter;
}

/* Finds the shortest paths from a position to the others. */
static void find_ways(struct tour *tour, uint32_t place, uint32_t count, double way_mm[])
{
    bool goes_on = true;

    for (uint32_t i = 0; i < tour->tangent_count; i++) {
        struct tour_tangent *it = &tour->tangents[i];

        it->is_new = it->from / TOUR_SIDES == place;
        it->way_mm = it->is_new ? it->length_mm : HUGE_VAL;
    }
    while (goes_on) {
        goes_on = false;
        for (uint32_t i = 0; i < tour->tangent_count; i++)
            if (tour->tangents[i].is_new) {
                tour->tangents[i].is_new = false;
                goes_on |= go_on(tour, &tour->tangents[i]);
            }
    }
    for (uint32_t i = 0; i < count; i++)
        way_mm[i] = HUGE_VAL;
    for (uint32_t i = 0; i < tour->tangent_count; i++)
        if (tour->tangents[i].to / TOUR_SIDES < count)
            way_mm[tour->tangents[i].to / TOUR_SIDES] =
                fmin(way_mm[tour->tangents[i].to / TOUR_SIDES], tour->tangents[i].way_mm);
}

/* The shortest path from a position through the remaining ones, one bit each. */
static double through_mm(double way_mm[][TOUR_PLACES_MAX], uint32_t place, uint32_t left)
{
    double best = left ? HUGE_VAL : 0.0;

    for (uint32_t next = 1; next < TOUR_PLACES_MAX; next++)
        if (left & 1u << next)
            best = fmin(best, way_mm[place][next] + through_mm(way_mm, next, left & ~(1u << next)));
    return best;
}

static void begin(struct tour *tour, const struct obstacles *obstacles, double body_radius_mm)
{
    double room_mm = body_radius_mm - DOUBT_MM;

    tour->low = (struct vector){room_mm, room_mm};
    tour->high = (struct vector){obstacles->width_mm - room_mm, obstacles->height_mm - room_mm};
    tour->thing_count = tour->round_count = 0;
    for (unsigned i = 0; i < TOUR_RIM; i++)
        tour->rim[i] = trig_along(2.0 * HALF_TURN_RAD / TOUR_RIM * i);
    for (size_t i = 0; i < obstacles->bar_count; i++)
        capsule_set(&tour->things[tour->thing_count++], obstacles->bars[i].a, obstacles->bars[i].b,
                    obstacles->bar_radius_mm + room_mm);
    for (size_t i = 0; i < obstacles->plant_count; i++)
        capsule_set(&tour->things[tour->thing_count++], obstacles->plants[i].at, obstacles->plants[i].at,
                    obstacles->plants[i].radius_mm + room_mm);
}

double tour_mm(struct tour *tour, const struct obstacles *obstacles, double body_radius_mm,
               const struct vector places[], uint32_t count)
{
    double way_mm[TOUR_PLACES_MAX][TOUR_PLACES_MAX];

    if (count > TOUR_PLACES_MAX || obstacles->bar_count + obstacles->plant_count > TOUR_THINGS_MAX)
        return HUGE_VAL;
    begin(tour, obstacles, body_radius_mm);
    for (uint32_t i = 0; i < count; i++)
        add_round(tour, places[i], 0.0);
    for (uint32_t i = 0; i < tour->thing_count; i++) {
        add_round(tour, tour->things[i].a, tour->things[i].radius_mm + DOUBT_MM);
        if (i < obstacles->bar_count)
            add_round(tour, tour->things[i].b, tour->things[i].radius_mm + DOUBT_MM);
    }
    add_tangents(tour);
    if (tour->tangent_count == tour->tangents_max)
        return HUGE_VAL;
    for (uint32_t i = 0; i < count; i++)
        find_ways(tour, i, count, way_mm[i]);
    return through_mm(way_mm, 0, (1u << count) - 2);
}
