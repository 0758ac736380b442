#include "host_sim/world/native/space/plain_near.h"

#include "host_sim/world/native/space/plain_space.h"
#include "host_sim/world/native/vector_sums.h"

struct plain_choice plain_near_capsules(const struct plain_world *space, struct vector at)
{
    const struct plain_grid *grid = space->grid;
    uint32_t cell;

    if (!grid)
        return (struct plain_choice){NULL, space->capsule_count};
    cell = plain_grid_cell(grid, at);
    return (struct plain_choice){grid->numbers + grid->firsts[cell], grid->firsts[cell + 1] - grid->firsts[cell]};
}

size_t plain_near_bodies(const struct world *world, struct vector at, uint32_t bodies[PLAIN_NEAR_MAX])
{
    const struct plain_grid *grid = plain_world_of(world)->grid;
    size_t count = world->body_count < PLAIN_NEAR_MAX ? world->body_count : PLAIN_NEAR_MAX;

    if (grid)
        return plain_grid_near(grid, at, bodies);
    for (size_t i = 0; i < count; i++)
        bodies[i] = (uint32_t)i;
    return count;
}

/* A line of sight, which something may block. */
struct view {
    const struct world *world;
    const struct body *body;
    struct vector from;
    struct vector to;
};

static bool is_behind_capsule(const struct view *view, struct vector at)
{
    const struct plain_world *space = plain_world_of(view->world);
    const struct plain_choice near = plain_near_capsules(space, at);

    for (size_t i = 0; i < near.count; i++)
        if (capsule_hides(&space->capsules[plain_chosen(&near, i)], view->from, view->to))
            return true;
    return false;
}

static bool is_behind_body(const struct view *view, struct vector at)
{
    uint32_t near[PLAIN_NEAR_MAX];
    double radius_mm = plain_world_of(view->world)->body_radius_mm;
    size_t count = view->world->body_count > 1 ? plain_near_bodies(view->world, at, near) : 0;

    for (size_t i = 0; i < count; i++) {
        const struct body *other = &view->world->bodies[near[i]];

        if (other != view->body && !other->lifted
            && capsule_disc_hides(plain_position(other), radius_mm, view->from, view->to))
            return true;
    }
    return false;
}

bool plain_view_hides(const struct world *world, const struct body *body, struct vector point)
{
    const struct view view = {world, body, plain_position(body), point};
    const struct plain_grid *grid = plain_world_of(world)->grid;
    struct vector way = vector_to(view.from, point);
    double length_mm = vector_length(way), step_mm = grid ? grid->cell_mm / 2 : 2 * length_mm + 1.0;

    /* Whatever blocks the view is within range of the nearest of these points. */
    for (double far_mm = 0.0; far_mm < length_mm + step_mm / 2; far_mm += step_mm) {
        double share = length_mm > 0.0 ? far_mm / length_mm : 0.0;
        struct vector at = vector_add(view.from, vector_scale(way, share));

        if (is_behind_capsule(&view, at) || is_behind_body(&view, at))
            return true;
    }
    return false;
}

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
