#include "host_sim/world/native/draw/layout.h"

#include <math.h>
#include <string.h>

#include "host_sim/world/native/trig.h"

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

static const double DOUBT = 1e-9;   /* of a squared distance: far more than rounding, far less than matters */

static double lesser(double a, double b)
{
    return a < b ? a : b;
}

static double walls_mm(const struct obstacles *obstacles, struct vector at)
{
    return lesser(lesser(at.x, obstacles->width_mm - at.x), lesser(at.y, obstacles->height_mm - at.y));
}

/* Vector from the nearest point of a bar's centre line to a point. */
static struct vector off_line(const struct bar *bar, struct vector at)
{
    double dx = bar->b.x - bar->a.x, dy = bar->b.y - bar->a.y;
    double along = ((at.x - bar->a.x) * dx + (at.y - bar->a.y) * dy) / (dx * dx + dy * dy);
    double inside = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;

    return (struct vector){at.x - bar->a.x - inside * dx, at.y - bar->a.y - inside * dy};
}

static struct vector off_plant(const struct plant *plant, struct vector at)
{
    return (struct vector){at.x - plant->at.x, at.y - plant->at.y};
}

static double beyond_mm(struct vector off, double radius_mm)
{
    return trig_hypot(off.x, off.y) - radius_mm;
}

double clearance_mm(const struct obstacles *obstacles, struct vector at)
{
    double nearest = walls_mm(obstacles, at);

    for (size_t i = 0; i < obstacles->bar_count; i++)
        nearest = lesser(nearest, beyond_mm(off_line(&obstacles->bars[i], at), obstacles->bar_radius_mm));
    for (size_t i = 0; i < obstacles->plant_count; i++)
        nearest = lesser(nearest, beyond_mm(off_plant(&obstacles->plants[i], at), obstacles->plants[i].radius_mm));
    return nearest;
}

/* Computes the square root only where it could change the answer. */
static bool is_clear(struct vector off, double radius_mm, double room_mm)
{
    double squared = off.x * off.x + off.y * off.y, limit = (room_mm + radius_mm) * (room_mm + radius_mm);

    if (squared > limit * (1.0 + DOUBT))
        return true;
    return squared >= limit * (1.0 - DOUBT) && beyond_mm(off, radius_mm) >= room_mm;
}

bool clearance_suffices(const struct obstacles *obstacles, struct vector at, double room_mm)
{
    if (walls_mm(obstacles, at) < room_mm)
        return false;
    for (size_t i = 0; i < obstacles->bar_count; i++)
        if (!is_clear(off_line(&obstacles->bars[i], at), obstacles->bar_radius_mm, room_mm))
            return false;
    for (size_t i = 0; i < obstacles->plant_count; i++)
        if (!is_clear(off_plant(&obstacles->plants[i], at), obstacles->plants[i].radius_mm, room_mm))
            return false;
    return true;
}

enum { BORDER = 2 };   /* rows and columns around those of the arena */
enum { BLOCKED, REACHED, FREE };

struct box {
    struct vector low;
    struct vector high;
};

static uint32_t cells_along(double size_mm)
{
    return (uint32_t)ceil(size_mm / REACH_CELL_MM) + BORDER;
}

size_t reach_size(double width_mm, double height_mm)
{
    return (size_t)cells_along(height_mm) * cells_along(width_mm);
}

/* The row or column of a position, clamped to the border. */
static uint32_t line_of(double at_mm, uint32_t lines)
{
    double line = floor(at_mm / REACH_CELL_MM) + 1;

    return line <= 0.0 ? 0 : line >= lines ? lines - 1 : (uint32_t)line;
}

static uint32_t cell_of(const struct reach *reach, struct vector at)
{
    return line_of(at.y, reach->rows) * reach->columns + line_of(at.x, reach->columns);
}

static double middle_of(uint32_t line)
{
    return (line - 0.5) * REACH_CELL_MM;
}

struct vector reach_middle(const struct reach *reach, uint32_t cell)
{
    return (struct vector){middle_of(cell % reach->columns), middle_of(cell / reach->columns)};
}

/* Blocks the cells of a box whose middles are too near an obstacle. */
static void block(struct reach *reach, const struct obstacles *obstacles, struct box box, double room_mm)
{
    uint32_t left = line_of(box.low.x, reach->columns), right = line_of(box.high.x, reach->columns);
    uint32_t bottom = line_of(box.high.y, reach->rows);

    for (uint32_t row = line_of(box.low.y, reach->rows); row <= bottom; row++) {
        uint8_t *cells = reach->cells + row * reach->columns;

        for (uint32_t column = left; column <= right; column++)
            if (cells[column] != BLOCKED
                && !clearance_suffices(obstacles, (struct vector){middle_of(column), middle_of(row)}, room_mm))
                cells[column] = BLOCKED;
    }
}

/* Whether the middles of a row or column are too near the wall along it. */
static bool is_at_wall(uint32_t line, double size_mm, double room_mm)
{
    return middle_of(line) < room_mm || size_mm - middle_of(line) < room_mm;
}

static void block_edges(struct reach *reach, const struct obstacles *obstacles, double room_mm)
{
    for (uint32_t row = 0; row < reach->rows; row++)
        if (is_at_wall(row, obstacles->height_mm, room_mm))
            memset(reach->cells + row * reach->columns, BLOCKED, reach->columns);
    for (uint32_t column = 0; column < reach->columns; column++)
        for (uint32_t row = 0; row < reach->rows && is_at_wall(column, obstacles->width_mm, room_mm); row++)
            reach->cells[row * reach->columns + column] = BLOCKED;
}

static struct box around(struct vector a, struct vector b, double beyond_mm)
{
    return (struct box){{fmin(a.x, b.x) - beyond_mm, fmin(a.y, b.y) - beyond_mm},
                        {fmax(a.x, b.x) + beyond_mm, fmax(a.y, b.y) + beyond_mm}};
}

void reach_keep_clear(struct reach *reach, const struct obstacles *obstacles, double room_mm)
{
    struct obstacles one = {.width_mm = obstacles->width_mm, .height_mm = obstacles->height_mm,
                            .bar_radius_mm = obstacles->bar_radius_mm};

    block_edges(reach, obstacles, room_mm);
    one.bar_count = 1;
    for (size_t i = 0; i < obstacles->bar_count; i++) {
        one.bars = &obstacles->bars[i];
        block(reach, &one, around(one.bars->a, one.bars->b, room_mm + one.bar_radius_mm), room_mm);
    }
    one.bar_count = 0;
    one.plant_count = 1;
    for (size_t i = 0; i < obstacles->plant_count; i++) {
        one.plants = &obstacles->plants[i];
        block(reach, &one, around(one.plants->at, one.plants->at, room_mm + one.plants->radius_mm), room_mm);
    }
}

/* The next blocked cell: the border has one at the end of each row. */
static uint8_t *end_of(uint8_t *cell, uint32_t columns)
{
    return memchr(cell, BLOCKED, columns);
}

/* Pushes one cell of each free run of cells on the stack. */
static uint32_t *add_stretches(const struct reach *reach, uint32_t *top, uint8_t *first, const uint8_t *end)
{
    for (uint8_t *cell = first; cell < end; cell++) {
        if (*cell == FREE)
            *top++ = (uint32_t)(cell - reach->cells);
        if (*cell != BLOCKED)
            cell = end_of(cell, reach->columns);
    }
    return top;
}

/* Fills run by run of free cells in a row. Between two runs there is a blocked cell, so that there
 * are never more cells on the stack than in the arena. */
static void flood(struct reach *reach, uint32_t start)
{
    uint32_t *top = reach->stack, columns = reach->columns;

    *top++ = start;
    while (top > reach->stack) {
        uint8_t *first = reach->cells + *--top, *end;

        if (*first != FREE)
            continue;
        while (first[-1] == FREE)
            first--;
        end = end_of(first, columns);
        memset(first, REACHED, (size_t)(end - first));
        top = add_stretches(reach, top, first - columns, end - columns);
        top = add_stretches(reach, top, first + columns, end + columns);
    }
}

void reach_find(struct reach *reach, const struct obstacles *obstacles, double body_radius_mm, struct vector start)
{
    /* Clearance changes by at most the distance moved, and a cell's corners are farthest from its middle. */
    double room = body_radius_mm + REACH_CELL_MM * sqrt(0.5);
    size_t count = reach_size(obstacles->width_mm, obstacles->height_mm);
    uint8_t *cells = reach->cells;

    reach->columns = cells_along(obstacles->width_mm);
    reach->rows = cells_along(obstacles->height_mm);
    memset(cells, FREE, count);
    reach_keep_clear(reach, obstacles, room);
    flood(reach, cell_of(reach, start));
    for (size_t i = 0; i < count; i++)
        cells[i] = cells[i] == REACHED;
}

bool reach_has(const struct reach *reach, struct vector at)
{
    return reach->cells[cell_of(reach, at)] == REACHED;
}

double reach_distance_mm(const struct reach *reach, struct vector from)
{
    double nearest = HUGE_VAL;

    for (uint32_t i = 0; i < reach->rows * reach->columns; i++) {
        struct vector middle = reach_middle(reach, i);

        if (reach->cells[i] == REACHED)
            nearest = fmin(nearest, trig_hypot(middle.x - from.x, middle.y - from.y));
    }
    return nearest;
}
