#include "host_sim/world/native/draw/draw.h"

#include <math.h>

#include "host_sim/world/native/draw/written.h"
#include "host_sim/world/native/trig.h"

struct pose draw_pose(struct draws *draws, const struct layout_params *params)
{
    struct pose pose;

    pose.at.x = draws_between(draws, 0.0, params->width_mm);
    pose.at.y = draws_between(draws, 0.0, params->height_mm);
    pose.heading_rad = draws_between(draws, -DRAW_PI, DRAW_PI);
    return pose;
}

void draw_food_and_start(struct draws *draws, const struct layout_params *params, struct layout *out)
{
    out->food_count = params->food_count;
    for (uint32_t i = 0; i < params->food_count; i++) {
        out->food[i].x = draws_between(draws, params->food_min_mm[i], params->food_max_mm[i]);
        out->food[i].y = draws_between(draws, 0.0, params->height_mm);
    }
    out->starts[0] = draw_pose(draws, params);
    out->start_count = 1;
}

/* It fits between the walls, round ends included. */
static struct bar draw_bar(struct draws *draws, const struct layout_params *params)
{
    double radius = params->bar_thickness_mm / 2;
    double half = (draws_between(draws, params->bar_min_mm, params->bar_max_mm) - params->bar_thickness_mm) / 2;
    double angle = draws_between(draws, 0.0, DRAW_PI);
    double dx = half * trig_cos(angle), dy = half * trig_sin(angle);
    double margin_x = fabs(dx) + radius, margin_y = fabs(dy) + radius;
    double x = draws_between(draws, margin_x, params->width_mm - margin_x);
    double y = draws_between(draws, margin_y, params->height_mm - margin_y);

    return (struct bar){{x - dx, y - dy}, {x + dx, y + dy}};
}

void draw_bars(struct draws *draws, const struct layout_params *params, struct layout *out)
{
    out->bar_count = params->bar_count;
    for (uint32_t i = 0; i < params->bar_count; i++)
        out->bars[i] = draw_bar(draws, params);
    draw_food_and_start(draws, params, out);
}

static const double CORRIDOR_MM = 800.0, DOOR_MIN_MM = 450.0, DOOR_MAX_MM = 650.0;

/* A wall along y, in two parts. */
static void draw_wall(struct draws *draws, double at_mm, double length_mm, struct bar parts[2])
{
    double door = draws_between(draws, DOOR_MIN_MM, DOOR_MAX_MM);
    double first = draws_between(draws, door / 2, length_mm - 1.5 * door);

    parts[0] = (struct bar){{at_mm, 0.0}, {at_mm, first}};
    parts[1] = (struct bar){{at_mm, first + door}, {at_mm, length_mm}};
}

static struct vector mirrored(struct vector at)
{
    return (struct vector){at.y, at.x};
}

void draw_corridors(struct draws *draws, const struct layout_params *params, struct layout *out)
{
    bool upright = draws_next(draws) >= 0.5;
    double across = upright ? params->width_mm : params->height_mm;
    double along = upright ? params->height_mm : params->width_mm;
    unsigned count = (unsigned)nearbyint(across / CORRIDOR_MM);

    out->bar_count = 0;
    for (unsigned wall = 1; wall < count && out->bar_count + 2 <= LAYOUT_BARS_MAX; wall++) {
        draw_wall(draws, across * wall / count, along, &out->bars[out->bar_count]);
        out->bar_count += 2;
    }
    for (uint32_t i = 0; i < out->bar_count && !upright; i++)
        out->bars[i] = (struct bar){mirrored(out->bars[i].a), mirrored(out->bars[i].b)};
    draw_food_and_start(draws, params, out);
}

enum { POCKETS = 4, POCKET_BARS = 3 };

static const double WIDTH_MIN_MM = 380.0, WIDTH_MAX_MM = 600.0, DEPTH_MIN_MM = 400.0, DEPTH_MAX_MM = 800.0;

static struct vector ahead_of(struct vector at, double distance_mm, double angle_rad)
{
    return (struct vector){at.x + distance_mm * trig_cos(angle_rad), at.y + distance_mm * trig_sin(angle_rad)};
}

/* The back of a pocket and its two sides. */
static void draw_pocket(struct draws *draws, const struct layout_params *params, struct bar out[POCKET_BARS])
{
    struct pose middle = draw_pose(draws, params);
    double width = draws_between(draws, WIDTH_MIN_MM, WIDTH_MAX_MM);
    double depth = draws_between(draws, DEPTH_MIN_MM, DEPTH_MAX_MM);
    struct vector left = ahead_of(middle.at, width / 2, middle.heading_rad - DRAW_PI / 2);
    struct vector right = ahead_of(middle.at, width / 2, middle.heading_rad + DRAW_PI / 2);

    out[0] = (struct bar){left, right};
    out[1] = (struct bar){left, ahead_of(left, depth, middle.heading_rad)};
    out[2] = (struct bar){right, ahead_of(right, depth, middle.heading_rad)};
}

static bool is_inside(struct vector at, const struct layout_params *params)
{
    double edge = params->bar_thickness_mm / 2;

    return at.x >= edge && at.x <= params->width_mm - edge && at.y >= edge && at.y <= params->height_mm - edge;
}

static bool fits(const struct bar pocket[POCKET_BARS], const struct layout_params *params)
{
    for (unsigned i = 0; i < POCKET_BARS; i++)
        if (!is_inside(pocket[i].a, params) || !is_inside(pocket[i].b, params))
            return false;
    return true;
}

void draw_dead_ends(struct draws *draws, const struct layout_params *params, struct layout *out)
{
    out->bar_count = 0;
    while (out->bar_count < POCKETS * POCKET_BARS) {
        struct bar *pocket = &out->bars[out->bar_count];

        draw_pocket(draws, params, pocket);
        if (fits(pocket, params))
            out->bar_count += POCKET_BARS;
    }
    draw_food_and_start(draws, params, out);
}

static uint32_t count_of(const struct reach *reach)
{
    uint32_t count = 0;

    for (uint32_t i = 0; i < reach->rows * reach->columns; i++)
        count += reach->cells[i];
    return count;
}

/* The middle of the nth cell that can be reached, from 0. */
static struct vector place(const struct reach *reach, uint32_t which)
{
    uint32_t cell = 0;

    while (!reach->cells[cell] || which-- > 0)
        cell++;
    return reach_middle(reach, cell);
}

/* Draws a position from which all food can be reached: a cell with enough room, or the place of a piece of food. */
static struct vector draw_place(struct draws *draws, const struct layout_params *params, struct reach *reach,
                                const struct layout *layout)
{
    struct obstacles obstacles = layout_obstacles(layout, params);
    uint32_t cells, which;

    reach_find(reach, &obstacles, params->body_radius_mm, layout->food[0]);
    reach_keep_clear(reach, &obstacles, layout_room_mm(params));
    cells = count_of(reach);
    which = (uint32_t)(draws_next(draws) * (cells + layout->food_count));
    return which < cells ? place(reach, which) : layout->food[which - cells];
}

void draw_written(struct draws *draws, const struct layout_kind *kind, struct reach *reach, struct layout *out)
{
    const struct written_entry *start = &kind->written->start;
    double heading = start->numbers[2] * (DRAW_PI / 180.0);

    written_lay_out(kind->written, out);
    out->start_count = 1;
    if (start->count == WRITTEN_LEFT_OUT) {
        out->starts[0].at = draw_place(draws, &kind->params, reach, out);
        out->starts[0].heading_rad = draws_between(draws, -DRAW_PI, DRAW_PI);
    } else {
        out->starts[0] = (struct pose){{start->numbers[0], start->numbers[1]}, remainder(heading, 2 * DRAW_PI)};
    }
}
