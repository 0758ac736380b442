#include "host_sim/world/native/ranges.h"

#include "host_sim/world/native/trig.h"
#include "host_sim/world/native/vector_sums.h"

static const double RAD_PER_DEG = 3.141592653589793 / 180.0;
static const double APART_DEG = 45.0;   /* between the middles of neighbouring cones */
static const double FAR_MM = 1e9;   /* no obstacle */

enum { FRONT = 2 };

/* The view of a body that measures; cone 0 is rightmost. */
struct view {
    const struct ranges *ranges;
    struct vector at;
    struct vector right[FEEL_COUNT], left[FEEL_COUNT];   /* the edges of the cones */
    bool is_seamless;              /* whether each cone's right edge is the left edge of the cone before */
    double found_mm[FEEL_COUNT];   /* from the centre of the body, so far */
};

static double less(double one, double other)
{
    return one < other ? one : other;
}

/* The distance along a ray to a circle. */
static double to_circle(struct vector ray, struct vector middle, double radius_mm)
{
    double ahead_mm = vector_dot(middle, ray), aside_mm = vector_cross(ray, middle);

    if (ahead_mm < 0.0 || aside_mm * aside_mm > radius_mm * radius_mm)
        return FAR_MM;
    return ahead_mm - vector_root(radius_mm * radius_mm - aside_mm * aside_mm);
}

/* The distance along a ray to the nearer straight side of a capsule. */
static double to_side(struct vector ray, struct vector a, struct vector b, double radius_mm)
{
    double length_mm = vector_length(vector_to(a, b)), line_mm, side_mm, toward, distance_mm, from_a_mm;
    struct vector way;

    if (length_mm == 0.0)
        return FAR_MM;
    way = vector_scale(vector_to(a, b), 1.0 / length_mm);
    line_mm = vector_cross(way, a);   /* signed distance from the ray's origin to the line */
    toward = vector_cross(way, ray);
    side_mm = line_mm > 0.0 ? line_mm - radius_mm : line_mm + radius_mm;
    if (line_mm * side_mm <= 0.0 || toward * side_mm <= 0.0)
        return FAR_MM;
    distance_mm = side_mm / toward;
    from_a_mm = vector_dot(vector_to(a, vector_scale(ray, distance_mm)), way);
    return from_a_mm >= 0.0 && from_a_mm <= length_mm ? distance_mm : FAR_MM;
}

/* The distance to a capsule in one direction. */
static double along(const struct view *view, const struct capsule *thing, struct vector ray)
{
    struct vector a = vector_to(view->at, thing->a), b = vector_to(view->at, thing->b);
    double to_ends_mm = less(to_circle(ray, a, thing->radius_mm), to_circle(ray, b, thing->radius_mm));

    return less(to_ends_mm, to_side(ray, a, b, thing->radius_mm));
}

static bool is_within(const struct view *view, unsigned cone, struct vector way)
{
    return vector_cross(view->left[cone], way) >= 0.0 && vector_cross(way, view->right[cone]) >= 0.0;
}

static double reach_mm(const struct ranges *ranges, unsigned cone)
{
    return cone == FRONT ? ranges->reach_mm + ranges->front_extra_mm : ranges->reach_mm;
}

/* Seen from outside, a capsule is nearest in one direction, and farther away the more one looks to either side. So
 * its nearest point within a cone is in that direction, or else on one of the cone's two edges. */
static void measure_thing(struct view *view, const struct capsule *thing)
{
    struct vector nearest = vector_to(view->at, capsule_nearest(thing, view->at));
    double near_mm = vector_length(nearest) - thing->radius_mm, left_mm = FAR_MM;

    if (near_mm > reach_mm(view->ranges, FRONT))
        return;
    for (unsigned n = 0; n < FEEL_COUNT; n++) {
        double right_mm = n > 0 && view->is_seamless ? left_mm : along(view, thing, view->right[n]);

        left_mm = along(view, thing, view->left[n]);
        view->found_mm[n] = less(view->found_mm[n], is_within(view, n, nearest) ? near_mm : less(right_mm, left_mm));
    }
}

static void measure_bodies(struct view *view, const struct world *world, const struct body *body)
{
    for (size_t i = 0; i < world->body_count; i++) {
        const struct body *other = &world->bodies[i];
        const struct vector at = {other->x_mm, other->y_mm};
        const struct capsule disc = {.a = at, .b = at, .radius_mm = view->ranges->body_radius_mm};

        if (other != body && !other->lifted)
            measure_thing(view, &disc);
    }
}

static struct vector turned(struct vector ahead, struct vector way)
{
    return (struct vector){ahead.x * way.x - ahead.y * way.y, ahead.y * way.x + ahead.x * way.y};
}

static void look_around(struct view *view, double heading_rad, double width_deg)
{
    /* Unit vectors along the edges of seamless cones, 112.5 to -112.5 degrees, for a body that faces +x. */
    static const double COS_67 = 0.38268343236508984, SIN_67 = 0.9238795325112867;
    const struct vector seamless[] = {
        {-COS_67, SIN_67}, {COS_67, SIN_67}, {SIN_67, COS_67},
        {SIN_67, -COS_67}, {COS_67, -SIN_67}, {-COS_67, -SIN_67}
    };
    struct vector ahead = trig_along(heading_rad);

    view->is_seamless = width_deg >= APART_DEG;
    for (unsigned n = 0; n < FEEL_COUNT; n++) {
        double middle_deg = APART_DEG * (FRONT - (double)n);

        view->right[n] = turned(ahead, view->is_seamless ? seamless[n]
                                : trig_along((middle_deg + width_deg / 2.0) * RAD_PER_DEG));
        view->left[n] = turned(ahead, view->is_seamless ? seamless[n + 1]
                               : trig_along((middle_deg - width_deg / 2.0) * RAD_PER_DEG));
        view->found_mm[n] = FAR_MM;
    }
}

/* Converts a distance from the centre of a body to the number sent to its robot. */
static uint8_t range_to(const struct ranges *ranges, double found_mm, unsigned cone)
{
    double range_mm = vector_whole(found_mm - ranges->body_radius_mm);

    if (found_mm > reach_mm(ranges, cone))
        return RANGE_NONE;
    return range_mm > 0.0 ? (uint8_t)range_mm : 0;
}

void ranges_measure(const struct ranges *ranges, const struct world *world, const struct body *body,
                    uint8_t *range_mm)
{
    struct view view = {.ranges = ranges, .at = {body->x_mm, body->y_mm}};

    look_around(&view, body->heading_rad, ranges->cone_deg > 0.0 ? ranges->cone_deg : APART_DEG);
    for (size_t i = 0; i < ranges->capsule_count && !body->lifted; i++)
        if (capsule_apart_mm(&ranges->capsules[i], view.at) <= reach_mm(ranges, FRONT))
            measure_thing(&view, &ranges->capsules[i]);
    if (!body->lifted)
        measure_bodies(&view, world, body);
    for (unsigned n = 0; n < FEEL_COUNT; n++)
        range_mm[n] = range_to(ranges, view.found_mm[n], n);
}
