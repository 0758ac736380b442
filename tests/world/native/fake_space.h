/* fake_space.h: a space whose answers a test sets, and which records its calls. */
#ifndef FAKE_SPACE_H
#define FAKE_SPACE_H

#include <string.h>

#include "host_sim/world/native/world.h"

enum { FAKE_STEPS = 16 };

struct fake {
    double depths[FAKE_STEPS];   /* of body 0 after each placing in turn; 0 after the last */
    struct vector normal;        /* of these overlaps */
    size_t steps;
    struct vector position;      /* where a body was placed last */
    bool hides;                  /* something is in every line of sight */
};

static struct fake fake;

enum { BODIES = 3, FOOD = 4 };

static struct body bodies[BODIES];
static struct food food[FOOD];

static void place(struct world *world, struct body *body)
{
    fake.position = (struct vector){body->x_mm, body->y_mm};
    world->bodies[0].depth_mm = fake.steps < FAKE_STEPS ? fake.depths[fake.steps] : 0.0;
    world->bodies[0].normal = fake.normal;
    fake.steps++;
}

static bool hides(const struct world *world, const struct body *body, struct vector point)
{
    (void)world;
    (void)body;
    (void)point;
    return fake.hides;
}

static struct space space = {place, hides};

/* A world of bodies at (1000, 1000) that face +x, and of food that a test places. */
static inline void fake_open(struct world *world, size_t body_count, size_t food_count)
{
    static const struct world_params params = {160.0, 100.0, 150.0, 0.02, 500.0};

    memset(&fake, 0, sizeof fake);
    memset(bodies, 0, sizeof bodies);
    memset(food, 0, sizeof food);
    *world = (struct world){.space = &space, .params = params, .body_count = body_count, .food_count = food_count,
        .bodies = bodies, .food = food};
    for (size_t i = 0; i < body_count; i++) {
        bodies[i].x_mm = bodies[i].y_mm = 1000.0;
        bodies[i].seen = -1;
    }
    world_begin(world);
}

#endif
