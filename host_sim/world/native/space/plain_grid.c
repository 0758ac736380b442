#include "host_sim/world/native/space/plain_grid.h"

static uint32_t part(double at_mm, double cell_mm, uint32_t count)
{
    if (!(at_mm > 0.0))
        return 0;
    return at_mm >= cell_mm * count ? count - 1 : (uint32_t)(at_mm / cell_mm);
}

uint32_t plain_grid_cell(const struct plain_grid *grid, struct vector at)
{
    return part(at.y, grid->cell_mm, grid->rows) * grid->columns + part(at.x, grid->cell_mm, grid->columns);
}

static double border_mm(double at_mm, double cell_mm, uint32_t number)
{
    double before_mm = at_mm - cell_mm * number, after_mm = cell_mm - before_mm;

    return before_mm < after_mm ? before_mm : after_mm;
}

double plain_grid_border_mm(const struct plain_grid *grid, struct vector at)
{
    double across_mm = border_mm(at.x, grid->cell_mm, part(at.x, grid->cell_mm, grid->columns));
    double down_mm = border_mm(at.y, grid->cell_mm, part(at.y, grid->cell_mm, grid->rows));

    return across_mm < down_mm ? across_mm : down_mm;
}

static void take_out(struct plain_grid *grid, uint32_t body)
{
    uint32_t *link = &grid->heads[grid->cells[body] - 1];

    while (*link != body + 1)
        link = &grid->nexts[*link - 1];
    *link = grid->nexts[body];
}

void plain_grid_put(struct plain_grid *grid, uint32_t body, struct vector at)
{
    uint32_t cell = plain_grid_cell(grid, at);

    if (grid->cells[body] == cell + 1)
        return;
    if (grid->cells[body] != 0)
        take_out(grid, body);
    grid->cells[body] = cell + 1;
    grid->nexts[body] = grid->heads[cell];
    grid->heads[cell] = body + 1;
}

size_t plain_grid_near(const struct plain_grid *grid, struct vector at, uint32_t bodies[PLAIN_NEAR_MAX])
{
    uint32_t column = part(at.x, grid->cell_mm, grid->columns), row = part(at.y, grid->cell_mm, grid->rows);
    uint32_t left = column ? column - 1 : 0, right = column + 1 < grid->columns ? column + 1 : column;
    uint32_t top = row ? row - 1 : 0, bottom = row + 1 < grid->rows ? row + 1 : row;
    size_t count = 0;

    for (uint32_t y = top; y <= bottom; y++)
        for (uint32_t x = left; x <= right; x++) {
            uint32_t next = grid->heads[y * grid->columns + x];

            for (; next && count < PLAIN_NEAR_MAX; next = grid->nexts[next - 1])
                bodies[count++] = next - 1;
        }
    return count;
}
