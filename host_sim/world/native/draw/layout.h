/* layout.h: what stands in an arena, how near it is, where a body can get to, and the layouts of new runs. */
#ifndef OCTET_LAYOUT_H
#define OCTET_LAYOUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "host_sim/world/native/vector.h"

/* The clearance of a place among obstacles. */

struct bar {   /* a straight obstacle with round ends: those of its centre line */
    struct vector a;
    struct vector b;
};

struct plant {   /* a round one */
    struct vector at;
    double radius_mm;
};

/* What stands in an arena, and its walls. */
struct obstacles {
    double width_mm;
    double height_mm;
    double bar_radius_mm;
    size_t bar_count;
    size_t plant_count;
    const struct bar *bars;
    const struct plant *plants;
};

double clearance_mm(const struct obstacles *obstacles, struct vector at);
        /* The distance from a place to the nearest obstacle or wall; negative inside an obstacle or beyond a wall. */

bool clearance_suffices(const struct obstacles *obstacles, struct vector at, double room_mm);
        /* Whether that is at least room_mm; the same result, but faster. */

/* Finds where in an arena the centre of a body can get to, on a grid. */

enum { REACH_CELL_MM = 25 };

/* The cells that a body can get to. The caller provides cells and stack, reach_size of each. */
struct reach {
    uint8_t *cells;    /* row by row, with a border of one cell: 1 for those that it can get to, else 0 */
    uint32_t *stack;
    uint32_t columns;   /* with the border */
    uint32_t rows;
};

size_t reach_size(double width_mm, double height_mm);
        /* The number of cells of an arena. */

void reach_find(struct reach *reach, const struct obstacles *obstacles, double body_radius_mm, struct vector start);
        /* Finds the cells that a body of this size can get to from a start inside the arena. */

bool reach_has(const struct reach *reach, struct vector at);
        /* Whether it can get to the cell of a place inside the arena. */

void reach_keep_clear(struct reach *reach, const struct obstacles *obstacles, double room_mm);
        /* Keeps only the cells whose middle has that much clearance. */

struct vector reach_middle(const struct reach *reach, uint32_t cell);
        /* The middle of a cell. */

double reach_distance_mm(const struct reach *reach, struct vector from);
        /* The distance to the nearest middle of a cell that it can get to; infinite if there is none. */

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

/* Draws the layout of an environment, which its seed and number determine. */

struct layout_which {
    int64_t seed;
    int64_t number;
    uint32_t robots;   /* at least 1; more of them do not change the rest of the layout */
};

bool layouts_draw(const struct layout_kind *kind, const struct layout_which *which, struct reach *reach,
                  struct layout *out);
        /* Draws the first fair layout: nothing is within sensor reach of a start or of a piece of food, and every
           piece can be reached from each start. out->starts has room for the robots; start_count is the number that
           find room. False if 1000 draws gave no fair layout. reach is working memory for an arena of this size. */

#endif
