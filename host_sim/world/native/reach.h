/* reach.h: where in a layout the centre of a body can get to, on a grid, as host_sim/world/layouts.py has it. */
#ifndef OCTET_REACH_H
#define OCTET_REACH_H

#include <stddef.h>
#include <stdint.h>

struct reach_bar {
    double ax_mm;
    double ay_mm;
    double bx_mm;
    double by_mm;
    double left_mm;   /* the box of the places that are too near to it: set by reach_find */
    double top_mm;
    double right_mm;
    double bottom_mm;
};

struct reach {
    double width_mm;             /* of the arena */
    double height_mm;
    double cell_mm;
    double bar_radius_mm;
    double room_mm;              /* clearance that the middle of a free cell has at least */
    uint32_t rows;               /* of the grid, without its border of one blocked cell */
    uint32_t columns;
    size_t bar_count;
    struct reach_bar *bars;
    uint32_t *stack;             /* room for as many cells as there are, with the border */
};

void reach_find(const struct reach *reach, uint32_t start, uint8_t *cells);
        /* Sets the cells that can be got to from cell start to 1, all others to 0. Cells go row by row, border included. */

#endif
