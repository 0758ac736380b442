#include "host_sim/world/native/reach.h"

#include <math.h>
#include <stdbool.h>

static const double DOUBT = 1e-9;   /* of a squared distance: far more than rounding, far less than matters */

/* A wider limit than the bar's: beyond it there is no doubt. */
static void set_box(const struct reach *reach, struct reach_bar *bar)
{
    double limit = (reach->room_mm + reach->bar_radius_mm) * (1.0 + DOUBT);

    bar->left_mm = (bar->ax_mm < bar->bx_mm ? bar->ax_mm : bar->bx_mm) - limit;
    bar->right_mm = (bar->ax_mm < bar->bx_mm ? bar->bx_mm : bar->ax_mm) + limit;
    bar->top_mm = (bar->ay_mm < bar->by_mm ? bar->ay_mm : bar->by_mm) - limit;
    bar->bottom_mm = (bar->ay_mm < bar->by_mm ? bar->by_mm : bar->ay_mm) + limit;
}

static bool is_off_the_box(const struct reach_bar *bar, double x, double y)
{
    return x < bar->left_mm || x > bar->right_mm || y < bar->top_mm || y > bar->bottom_mm;
}

static bool is_clear_of(const struct reach *reach, const struct reach_bar *bar, double x, double y)
{
    double dx = bar->bx_mm - bar->ax_mm, dy = bar->by_mm - bar->ay_mm;
    double along = ((x - bar->ax_mm) * dx + (y - bar->ay_mm) * dy) / (dx * dx + dy * dy);
    double inside = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
    double off_x = x - bar->ax_mm - inside * dx, off_y = y - bar->ay_mm - inside * dy;
    double squared = off_x * off_x + off_y * off_y, limit = reach->room_mm + reach->bar_radius_mm;

    /* A square root is only worth its time where it could change the answer. */
    if (squared > limit * limit * (1.0 + DOUBT))
        return true;
    if (squared < limit * limit * (1.0 - DOUBT))
        return false;
    return hypot(off_x, off_y) - reach->bar_radius_mm >= reach->room_mm;
}

static bool is_free(const struct reach *reach, uint32_t row, uint32_t column)
{
    double x = (column + 0.5) * reach->cell_mm, y = (row + 0.5) * reach->cell_mm;

    if (x < reach->room_mm || reach->width_mm - x < reach->room_mm)
        return false;
    if (y < reach->room_mm || reach->height_mm - y < reach->room_mm)
        return false;
    for (size_t i = 0; i < reach->bar_count; i++)
        if (!is_off_the_box(&reach->bars[i], x, y) && !is_clear_of(reach, &reach->bars[i], x, y))
            return false;
    return true;
}

enum { UNKNOWN, REACHED, BLOCKED };

/* Whether a cell is free and has not been got to before; it is marked either way. */
static bool visit(const struct reach *reach, uint32_t cell, uint8_t *cells)
{
    uint32_t stride = reach->columns + 2, row = cell / stride, column = cell % stride;
    bool inside = row >= 1 && row <= reach->rows && column >= 1 && column <= reach->columns;

    if (cells[cell] != UNKNOWN)
        return false;
    cells[cell] = inside && is_free(reach, row - 1, column - 1) ? REACHED : BLOCKED;
    return cells[cell] == REACHED;
}

static void flood(const struct reach *reach, uint32_t start, uint8_t *cells)
{
    uint32_t stride = reach->columns + 2;
    uint32_t *top = reach->stack;

    if (visit(reach, start, cells))
        *top++ = start;
    while (top > reach->stack) {
        uint32_t cell = *--top;
        const uint32_t neighbours[] = {cell - 1, cell + 1, cell - stride, cell + stride};

        for (unsigned i = 0; i < 4; i++)
            if (visit(reach, neighbours[i], cells))
                *top++ = neighbours[i];
    }
}

void reach_find(const struct reach *reach, uint32_t start, uint8_t *cells)
{
    size_t count = (size_t)(reach->rows + 2) * (reach->columns + 2);

    for (size_t i = 0; i < reach->bar_count; i++)
        set_box(reach, &reach->bars[i]);
    for (size_t i = 0; i < count; i++)
        cells[i] = UNKNOWN;
    flood(reach, start, cells);
    for (size_t i = 0; i < count; i++)
        cells[i] = cells[i] == REACHED;
}
