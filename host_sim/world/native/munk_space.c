#include "host_sim/world/native/munk_space.h"

#include "host_sim/world/native/munk_contacts.h"
#include "host_sim/world/native/vector_sums.h"

static const double FAR_MM = 800.0;        /* farther is not worth looking */
static const double MARGIN_MM = 0.001;     /* far more than rounding */

static struct munk_world *of(const struct world *world)
{
    return (struct munk_world *)world->space;
}

static struct munk_place *place_of(const struct world *world, const struct body *body)
{
    return &of(world)->places[body - world->bodies];
}

/* Has the space find what a body overlaps. */
static void step(struct world *world, struct body *body)
{
    struct munk_world *space = of(world);
    const struct munk_place *place = place_of(world, body);
    struct munk_vector at = {body->x_mm, body->y_mm};

    space->munk->cpBodySetPosition(place->in_space, body->lifted ? place->in_the_air : at);
    space->munk->cpBodySetAngle(place->in_space, body->heading_rad);
    space->munk->cpSpaceStep(space->stepped, world->params.tick_s);
}

/* How far a body that overlaps nothing may go in any direction before it could. */
static double way_mm(const struct world *world, const struct body *body)
{
    const struct munk_world *space = of(world);
    struct munk_vector at = {body->x_mm, body->y_mm};
    struct munk_filter sight = place_of(world, body)->sight;
    struct munk_nearest nearest = {.distance = FAR_MM};

    if (body->feel != 0 || body->touches != 0 || body->lifted)
        return 0.0;
    (void)space->munk->cpSpacePointQueryNearest(space->stepped, at, FAR_MM, sight, &nearest);
    return (nearest.distance < FAR_MM ? nearest.distance : FAR_MM) - space->reach_mm - MARGIN_MM;
}

/* A body that is alone, and far from all obstacles, overlaps nothing: the space need not be asked. */
static bool is_free(struct munk_world *space, const struct body *body)
{
    struct vector way = vector_to(space->placed, (struct vector){body->x_mm, body->y_mm});

    return space->free_mm > 0.0 && vector_dot(way, way) < space->free_mm * space->free_mm;
}

static void place(struct world *world, struct body *body)
{
    struct munk_world *space = of(world);

    if (is_free(space, body))
        return;
    step(world, body);
    if (world->body_count > 1)
        return;
    space->placed = (struct vector){body->x_mm, body->y_mm};
    space->free_mm = way_mm(world, body);
}

static bool hides(const struct world *world, const struct body *body, struct vector point)
{
    const struct munk_world *space = of(world);
    struct munk_vector from = {body->x_mm, body->y_mm}, to = {point.x, point.y};
    struct munk_filter sight = place_of(world, body)->sight;
    struct munk_hit hit;

    return space->munk->cpSpaceSegmentQueryFirst(space->stepped, from, to, 0.0, sight, &hit) != NULL;
}

/* Gets a handler, notes what it was, and returns it. */
static struct munk_handler *borrow(struct munk_world *space, uintptr_t type_a, uintptr_t type_b)
{
    struct munk_handler *handler = space->munk->cpSpaceAddCollisionHandler(space->stepped, type_a, type_b);
    struct munk_loan *loan = &space->loans[space->loan_count++];

    loan->handler = handler;
    loan->before = *handler;
    return handler;
}

static void borrow_cones(struct munk_world *space, size_t index)
{
    struct munk_cone *cones = &space->cones[index * WORLD_CONES];
    uintptr_t type = space->places[index].first_cone;

    for (uint8_t n = 0; n < WORLD_CONES; n++) {
        cones[n].body = &space->world->bodies[index];
        cones[n].number = n;
        munk_contacts_of_cone(borrow(space, type + n, space->obstacle_type), &cones[n]);
        munk_contacts_of_cone(borrow(space, type + n, space->disc_type), &cones[n]);
    }
}

void munk_space_borrow(struct munk_world *space, struct world *world)
{
    space->space = (struct space){place, hides};
    space->world = world;
    world->space = &space->space;
    space->loan_count = 0;
    space->free_mm = 0.0;
    munk_contacts_of_discs(borrow(space, space->disc_type, space->obstacle_type), space);
    munk_contacts_of_discs(borrow(space, space->disc_type, space->disc_type), space);
    for (size_t i = 0; i < world->body_count; i++)
        borrow_cones(space, i);
}

void munk_space_return(struct munk_world *space)
{
    if (space->free_mm > 0.0)
        step(space->world, space->world->bodies);   /* it is where it was last placed */
    while (space->loan_count > 0) {
        const struct munk_loan *loan = &space->loans[--space->loan_count];

        *loan->handler = loan->before;
    }
}
