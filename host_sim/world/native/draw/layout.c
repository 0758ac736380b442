#include "host_sim/world/native/draw/layout.h"

struct obstacles layout_obstacles(const struct layout *layout, const struct layout_params *params)
{
    return (struct obstacles){
        .width_mm = params->width_mm,
        .height_mm = params->height_mm,
        .bar_radius_mm = params->bar_thickness_mm / 2,
        .bars = layout->bars,
        .bar_count = layout->bar_count,
    };
}

double layout_room_mm(const struct layout_params *params)
{
    return params->body_radius_mm + params->sensor_reach_mm;
}
