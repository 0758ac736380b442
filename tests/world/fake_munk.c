#include "tests/world/fake_munk.h"

#include <string.h>

enum { BODIES = 3, FOOD = 4, OBSTACLE = 1, DISC = 2, CONES = 100 };

struct fake_munk fake;
struct munk_world fake_space;

static struct body bodies[BODIES];
static struct food food[FOOD];
static struct munk_place places[BODIES];
static struct munk_cone cones[BODIES * WORLD_CONES];
static struct munk_loan loans[MUNK_LOANS + BODIES * MUNK_LOANS_EACH];
static struct world *opened;
static char discs[BODIES];   /* whose addresses stand for discs */

struct munk_shape *fake_disc(size_t body)
{
    return (struct munk_shape *)(void *)&discs[body];
}

static void step(struct munk_space *space, double seconds)
{
    double depth_mm = fake.steps < FAKE_STEPS ? fake.depths[fake.steps] : 0.0;

    (void)space;
    fake.steps++;
    fake.step_s = seconds;
    opened->bodies[0].depth_mm = depth_mm;
    opened->bodies[0].normal = fake.normal;
}

static struct munk_handler *add_handler(struct munk_space *space, uintptr_t type_a, uintptr_t type_b)
{
    struct munk_handler *handler = fake_handler(type_a, type_b);

    (void)space;
    if (!handler) {
        handler = &fake.handlers[fake.handler_count++];
        handler->type_a = type_a;
        handler->type_b = type_b;
    }
    return handler;
}

static struct munk_shape *query(struct munk_space *space, struct munk_vector start, struct munk_vector end,
    double radius, struct munk_filter filter, struct munk_hit *out)
{
    (void)space;
    (void)start;
    (void)end;
    (void)radius;
    (void)out;
    fake.sight = filter;
    return fake.hides ? fake_disc(BODIES - 1) : NULL;
}

static struct munk_shape *nearest(struct munk_space *space, struct munk_vector point, double distance_max,
    struct munk_filter filter, struct munk_nearest *out)
{
    (void)space;
    (void)point;
    (void)filter;
    if (fake.nearest_mm >= distance_max)
        return NULL;
    out->distance = fake.nearest_mm;
    return fake_disc(BODIES - 1);
}

static void set_position(struct munk_body *body, struct munk_vector position)
{
    (void)body;
    fake.position = position;
}

static void set_angle(struct munk_body *body, double angle)
{
    (void)body;
    fake.angle = angle;
}

static void get_shapes(struct munk_arbiter *arbiter, struct munk_shape **a, struct munk_shape **b)
{
    (void)arbiter;
    *a = fake.shapes[0];
    *b = fake.shapes[1];
}

static struct munk_contacts get_contacts(struct munk_arbiter *arbiter)
{
    (void)arbiter;
    return fake.contacts;
}

static const struct munk functions = {step, add_handler, query, nearest, set_position, set_angle, get_shapes, get_contacts};

struct munk_handler *fake_handler(uintptr_t type_a, uintptr_t type_b)
{
    for (size_t i = 0; i < fake.handler_count; i++)
        if (fake.handlers[i].type_a == type_a && fake.handlers[i].type_b == type_b)
            return &fake.handlers[i];
    return NULL;
}

void fake_open(struct world *world, size_t body_count, size_t food_count)
{
    static const struct world_params params = {160.0, 100.0, 150.0, 0.02, 500.0};

    memset(&fake, 0, sizeof fake);
    memset(bodies, 0, sizeof bodies);
    memset(food, 0, sizeof food);
    *world = (struct world){.params = params, .body_count = body_count, .food_count = food_count, .bodies = bodies,
        .food = food};
    fake_space = (struct munk_world){.munk = &functions, .obstacle_type = OBSTACLE, .disc_type = DISC,
        .reach_mm = 160.0,
        .places = places, .cones = cones, .loans = loans};
    for (size_t i = 0; i < body_count; i++) {
        bodies[i].x_mm = bodies[i].y_mm = 1000.0;
        bodies[i].seen = -1;
        places[i] = (struct munk_place){.disc = fake_disc(i), .in_the_air = {-10000.0, 0.0},
            .first_cone = CONES + i * WORLD_CONES};
    }
    world_begin(world);
    munk_space_borrow(&fake_space, world);
    opened = world;
}
