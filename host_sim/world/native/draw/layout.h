/* layout.h: the initial layout of an environment, and what it is drawn from. */
#ifndef OCTET_LAYOUT_H
#define OCTET_LAYOUT_H

#include <stdint.h>

#include "host_sim/world/native/clearance.h"

enum { LAYOUT_BARS_MAX = 64, LAYOUT_FOOD_MAX = 20 };

struct pose {
    struct vector at;
    double heading_rad;   /* -pi..pi */
};

struct layout {
    uint32_t bar_count;
    uint32_t food_count;
    uint32_t start_count;
    struct bar bars[LAYOUT_BARS_MAX];
    struct vector food[LAYOUT_FOOD_MAX];
    struct pose *starts;   /* of the robots; the caller provides them */
};

enum layout_style {
    LAYOUT_BARS,        /* of any length and angle, anywhere */
    LAYOUT_CORRIDORS,   /* walls across the whole arena, each with one door */
    LAYOUT_DEAD_ENDS,   /* pockets that are open on one side only */
    LAYOUT_WRITTEN      /* as a person wrote it */
};

/* Dimensions, as in SimParams. */
struct layout_params {
    double width_mm;
    double height_mm;
    double body_radius_mm;
    double sensor_reach_mm;
    double bar_thickness_mm;
    double bar_min_mm;   /* length of a bar, round ends included */
    double bar_max_mm;
    double food_min_mm[LAYOUT_FOOD_MAX];   /* x of each piece of food */
    double food_max_mm[LAYOUT_FOOD_MAX];
    uint32_t bar_count;    /* 0..LAYOUT_BARS_MAX */
    uint32_t food_count;   /* 0..LAYOUT_FOOD_MAX */
};

struct written;

/* A kind of environment. */
struct layout_kind {
    enum layout_style style;
    struct layout_params params;
    const struct written *written;   /* of LAYOUT_WRITTEN: without a fault */
};

struct obstacles layout_obstacles(const struct layout *layout, const struct layout_params *params);
        /* The obstacles of an arena with this layout. They point into the layout. */

double layout_room_mm(const struct layout_params *params);
        /* Clearance of starts and food: nothing is within reach of a robot's sensors there. */

#endif
