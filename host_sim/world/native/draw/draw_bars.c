#include "host_sim/world/native/draw/draw.h"

#include <math.h>

#include "host_sim/world/native/trig.h"

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
