#include "host_sim/world/native/draw/draw.h"

#include <math.h>

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
