#include "host_sim/world/native/draw/draw.h"

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
