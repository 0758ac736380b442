#include "host_sim/world/native/furniture.h"

void furniture_set(struct furniture *furniture, const struct bar bars[], size_t count)
{
    furniture->bar_count = count;
    furniture->plant_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        furniture->bars[i] = bars[i];
        furniture->bar_ids[i] = i;
    }
    furniture->next_bar_id = (uint32_t)count;
    furniture->next_plant_id = 0;
    furniture_lay_out(furniture);
}

void furniture_lay_out(struct furniture *furniture)
{
    struct capsule *at = furniture->capsules + WALLS;

    capsule_set_walls(furniture->capsules, furniture->width_mm, furniture->height_mm);
    for (size_t i = 0; i < furniture->bar_count; i++)
        capsule_set(at++, furniture->bars[i].a, furniture->bars[i].b, furniture->bar_radius_mm);
    for (size_t i = 0; i < furniture->plant_count; i++)
        capsule_set(at++, furniture->plants[i].at, furniture->plants[i].at, furniture->plants[i].radius_mm);
    furniture->capsule_count = (size_t)(at - furniture->capsules);
}

struct obstacles furniture_obstacles(const struct furniture *furniture)
{
    return (struct obstacles){
        .width_mm = furniture->width_mm,
        .height_mm = furniture->height_mm,
        .bar_radius_mm = furniture->bar_radius_mm,
        .bar_count = furniture->bar_count,
        .plant_count = furniture->plant_count,
        .bars = furniture->bars,
        .plants = furniture->plants,
    };
}
