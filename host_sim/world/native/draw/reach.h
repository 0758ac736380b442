/* reach.h: finds where in an arena the centre of a body can get to, on a grid. */
#ifndef OCTET_REACH_H
#define OCTET_REACH_H

#include <stdint.h>

#include "host_sim/world/native/clearance.h"

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

#endif
