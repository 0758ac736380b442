#include "host_sim/world/native/draw/draw.h"

#include "host_sim/world/native/trig.h"

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
