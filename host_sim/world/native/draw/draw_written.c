#include "host_sim/world/native/draw/draw.h"

#include <math.h>

#include "host_sim/world/native/draw/written.h"

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

/* Draws a position from which all food can be reached. There is room where the food is. */
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
