/* plain_near.h: finds what is near a place in a plain space, or in the line of sight to it. */
#ifndef OCTET_PLAIN_NEAR_H
#define OCTET_PLAIN_NEAR_H

#include <stdbool.h>

#include "host_sim/world/native/space/plain_space.h"

/* Some of a space's capsules. */
struct plain_choice {
    const uint32_t *numbers;   /* null: 0, 1, 2... */
    size_t count;
};

static inline size_t plain_chosen(const struct plain_choice *choice, size_t i)
{
    return choice->numbers ? choice->numbers[i] : i;
}

static inline struct plain_world *plain_world_of(const struct world *world)
{
    return (struct plain_world *)world->space;
}

static inline struct vector plain_position(const struct body *body)
{
    return (struct vector){body->x_mm, body->y_mm};
}

struct plain_choice plain_near_capsules(const struct plain_world *space, struct vector at);
        /* The capsules that can be felt from a place; all of them without a grid. */

size_t plain_near_bodies(const struct world *world, struct vector at, uint32_t bodies[PLAIN_NEAR_MAX]);
        /* The bodies around a place; all of them without a grid. */

bool plain_view_hides(const struct world *world, const struct body *body, struct vector point);
        /* Whether an obstacle or another body is between a body and a point. */

#endif
