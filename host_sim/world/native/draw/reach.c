#include "host_sim/world/native/draw/reach.h"
#include "host_sim/world/native/trig.h"

#include <math.h>
#include <string.h>

enum { BORDER = 2 };   /* rows, and columns, around those of the arena */
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

/* The row, or the column, of a place: of the border for those beyond it. */
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

/* Blocks the cells of a box whose middles are too near. */
static void block(struct reach *reach, const struct obstacles *obstacles, struct box box, double room_mm)
{
    uint32_t left = line_of(box.low.x, reach->columns), right = line_of(box.high.x, reach->columns);
    uint32_t bottom = line_of(box.high.y, reach->rows);

    for (uint32_t row = line_of(box.low.y, reach->rows); row <= bottom; row++)
        for (uint32_t column = left; column <= right; column++)
            if (!clearance_suffices(obstacles, (struct vector){middle_of(column), middle_of(row)}, room_mm))
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
    struct vector low = {-REACH_CELL_MM, -REACH_CELL_MM};
    struct vector high = {one.width_mm + REACH_CELL_MM, one.height_mm + REACH_CELL_MM};
    const struct box walls[] = {
        {low, {room_mm, high.y}}, {{one.width_mm - room_mm, low.y}, high},
        {low, {high.x, room_mm}}, {{low.x, one.height_mm - room_mm}, high},
    };

    for (unsigned i = 0; i < 4; i++)
        block(reach, &one, walls[i], room_mm);
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

static void flood(struct reach *reach, uint32_t start)
{
    uint32_t *top = reach->stack;
    uint8_t *cells = reach->cells;

    *top++ = start;
    while (top > reach->stack) {
        uint32_t cell = *--top;
        const uint32_t neighbours[] = {cell - 1, cell + 1, cell - reach->columns, cell + reach->columns};

        for (unsigned i = 0; i < 4; i++)
            if (cells[neighbours[i]] == FREE) {
                cells[neighbours[i]] = REACHED;
                *top++ = neighbours[i];
            }
    }
}

void reach_find(struct reach *reach, const struct obstacles *obstacles, double body_radius_mm, struct vector start)
{
    /* Clearance changes by at most the distance moved, and no point of a cell is farther from its middle than a corner. */
    double room = body_radius_mm + REACH_CELL_MM * sqrt(0.5);
    size_t count = reach_size(obstacles->width_mm, obstacles->height_mm);

    reach->columns = cells_along(obstacles->width_mm);
    reach->rows = cells_along(obstacles->height_mm);
    memset(reach->cells, FREE, count);
    reach_keep_clear(reach, obstacles, room);
    if (reach->cells[cell_of(reach, start)] == FREE) {
        reach->cells[cell_of(reach, start)] = REACHED;
        flood(reach, cell_of(reach, start));
    }
    for (size_t i = 0; i < count; i++)
        reach->cells[i] = reach->cells[i] == REACHED;
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
