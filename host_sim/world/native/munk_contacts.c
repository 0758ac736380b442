#include "host_sim/world/native/munk_contacts.h"

static void enter_cone(struct munk_arbiter *arbiter, struct munk_space *space, void *data)
{
    const struct munk_cone *cone = data;

    (void)arbiter;
    (void)space;
    cone->body->overlaps[cone->number]++;
    cone->body->feel = (uint8_t)(cone->body->feel | 1u << cone->number);
}

static void leave_cone(struct munk_arbiter *arbiter, struct munk_space *space, void *data)
{
    const struct munk_cone *cone = data;

    (void)arbiter;
    (void)space;
    if (--cone->body->overlaps[cone->number] == 0)
        cone->body->feel = (uint8_t)(cone->body->feel & ~(1u << cone->number));
}

static void ignore(struct munk_arbiter *arbiter, struct munk_space *space, void *data)
{
    (void)arbiter;
    (void)space;
    (void)data;
}

void munk_contacts_of_cone(struct munk_handler *handler, struct munk_cone *cone)
{
    handler->begin = enter_cone;
    handler->pre_solve = ignore;
    handler->separate = leave_cone;
    handler->data = cone;
}

static struct body *body_of(const struct munk_world *space, const struct munk_shape *shape)
{
    for (size_t i = 0; i < space->world->body_count; i++)
        if (space->places[i].disc == shape)
            return &space->world->bodies[i];
    return NULL;
}

/* The bodies that an arbiter's shapes belong to; null for an obstacle. */
static void find_touched(const struct munk_world *space, struct munk_arbiter *arbiter, struct body *touched[2])
{
    struct munk_shape *a, *b;

    space->munk->cpArbiterGetShapes(arbiter, &a, &b);
    touched[0] = body_of(space, a);
    touched[1] = body_of(space, b);
}

static void begin_touch(struct munk_arbiter *arbiter, struct munk_space *space, void *data)
{
    struct body *touched[2];

    (void)space;
    find_touched(data, arbiter, touched);
    for (unsigned i = 0; i < 2; i++)
        if (touched[i]) {
            touched[i]->touches++;
            touched[i]->collisions++;
        }
}

static void end_touch(struct munk_arbiter *arbiter, struct munk_space *space, void *data)
{
    struct body *touched[2];

    (void)space;
    find_touched(data, arbiter, touched);
    for (unsigned i = 0; i < 2; i++)
        if (touched[i])
            touched[i]->touches--;
}

/* Notes an overlap if it is the body's deepest of this step; the normal points out of the body. */
static void press(struct body *body, double depth_mm, struct munk_vector normal)
{
    if (body && depth_mm > body->depth_mm) {
        body->depth_mm = depth_mm;
        body->normal = (struct vector){normal.x, normal.y};
    }
}

static void press_touched(struct munk_arbiter *arbiter, struct munk_space *space, void *data)
{
    const struct munk_world *here = data;
    struct munk_contacts contacts = here->munk->cpArbiterGetContactPointSet(arbiter);
    struct munk_vector back = {-contacts.normal.x, -contacts.normal.y};
    struct body *touched[2];

    (void)space;
    find_touched(here, arbiter, touched);
    press(touched[0], -contacts.points[0].distance, contacts.normal);
    press(touched[1], -contacts.points[0].distance, back);
}

void munk_contacts_of_discs(struct munk_handler *handler, struct munk_world *space)
{
    handler->begin = begin_touch;
    handler->pre_solve = press_touched;
    handler->separate = end_touch;
    handler->data = space;
}
