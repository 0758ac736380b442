#include "host_sim/world/native/space/plain_near.h"

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
