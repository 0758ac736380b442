/* furniture.h: the obstacles of an arena. Bars and plants have ids 0, 1, ... in the order in which they are added. */
#ifndef OCTET_FURNITURE_H
#define OCTET_FURNITURE_H

#include "host_sim/world/native/clearance.h"
#include "host_sim/world/native/draw/layout.h"
#include "host_sim/world/native/space/capsule.h"

enum { FURNITURE_BARS_MAX = LAYOUT_BARS_MAX, FURNITURE_PLANTS_MAX = 20 };
enum { FURNITURE_CAPSULES_MAX = WALLS + FURNITURE_BARS_MAX + FURNITURE_PLANTS_MAX };

struct furniture {
    double width_mm;        /* of the arena */
    double height_mm;
    double bar_radius_mm;
    double body_radius_mm;
    size_t bar_count;
    size_t plant_count;
    struct bar bars[FURNITURE_BARS_MAX];
    struct plant plants[FURNITURE_PLANTS_MAX];
    uint32_t bar_ids[FURNITURE_BARS_MAX];
    uint32_t plant_ids[FURNITURE_PLANTS_MAX];
    uint32_t next_bar_id;
    uint32_t next_plant_id;
    size_t capsule_count;
    struct capsule capsules[FURNITURE_CAPSULES_MAX];   /* walls, bars and plants */
};

void furniture_set(struct furniture *furniture, const struct bar bars[], size_t count);
        /* Starts with these bars and nothing else; width_mm to body_radius_mm must be set already. */

void furniture_lay_out(struct furniture *furniture);
        /* Rebuilds the capsules after a change. */

struct obstacles furniture_obstacles(const struct furniture *furniture);
        /* The obstacles as clearance.h and draw/reach.h take them. They point into it. */

#endif
