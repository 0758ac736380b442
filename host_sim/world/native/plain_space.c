#include "host_sim/world/native/plain_space.h"

#include "host_sim/world/native/vector_sums.h"

static const double MARGIN_MM = 0.001;   /* far more than rounding */
static const double FREE_MAX_MM = 1e6;

static struct plain_world *of(const struct world *world)
{
    return (struct plain_world *)world->space;
}

static struct vector position(const struct body *body)
{
    return (struct vector){body->x_mm, body->y_mm};
}

static size_t index_of(const struct world *world, const struct body *body)
{
    return (size_t)(body - world->bodies);
}

/* What was found about one body so far. */
struct finding {
    const struct plain_world *space;
    struct body *body;
    uint64_t *touching;
};

static void press(struct body *body, const struct contact *contact)
{
    if (contact->depth_mm > body->depth_mm) {
        body->depth_mm = contact->depth_mm;
        body->normal = contact->normal;
    }
}

/* A point as a body sees it. */
static struct vector seen_from(const struct body *body, struct vector point)
{
    struct vector way = vector_to(position(body), point);

    return (struct vector){vector_dot(way, body->ahead), vector_cross(body->ahead, way)};
}

static void feel(struct finding *finding, struct vector a, struct vector b, double radius_mm)
{
    struct body *body = finding->body;
    const struct capsule thing = {.a = seen_from(body, a), .b = seen_from(body, b), .radius_mm = radius_mm};

    for (unsigned n = 0; n < CONES; n++)
        if (cones_overlap(&finding->space->cones->of[n], &thing)) {
            body->overlaps[n]++;
            body->feel = (uint8_t)(body->feel | 1u << n);
        }
}

static bool is_far(const struct plain_world *space, const struct contact *contact, double radius_mm)
{
    double reach_mm = space->cones->reach_mm + radius_mm;

    return contact->apart_mm2 > reach_mm * reach_mm;
}

static void touch(struct finding *finding, const struct contact *contact, size_t number)
{
    if (!contact->touches)
        return;
    finding->touching[number / PLAIN_WORD_BITS] |= (uint64_t)1 << number % PLAIN_WORD_BITS;
    press(finding->body, contact);
}

/* How far a body may go before it could feel a thing that it is so far away from. */
static double way_to(const struct plain_world *space, double apart_mm)
{
    return apart_mm - space->cones->reach_mm - MARGIN_MM;
}

/* Meets one capsule. Returns how far away it is at least. */
static double meet_capsule(struct finding *finding, size_t number)
{
    const struct plain_world *space = finding->space;
    const struct capsule *capsule = &space->capsules[number];
    double apart_mm = capsule_apart_mm(capsule, position(finding->body));
    struct contact contact;

    if (apart_mm > space->cones->reach_mm)
        return apart_mm;
    capsule_meet_disc(capsule, position(finding->body), space->body_radius_mm, &contact);
    if (is_far(space, &contact, capsule->radius_mm))
        return vector_root(contact.apart_mm2) - capsule->radius_mm;
    touch(finding, &contact, number);
    feel(finding, capsule->a, capsule->b, capsule->radius_mm);
    return 0.0;
}

static void meet_capsules(struct finding *finding, struct plain_place *place)
{
    const struct plain_world *space = finding->space;
    double free_mm = place->free_mm;

    if (free_mm > 0.0)
        return;
    free_mm = FREE_MAX_MM;
    for (size_t i = 0; i < space->capsule_count; i++) {
        double way_mm = way_to(space, meet_capsule(finding, i));

        if (way_mm < free_mm)
            free_mm = way_mm;
    }
    place->free_mm = free_mm;
}

static void meet_bodies(struct finding *finding, const struct world *world)
{
    const struct plain_world *space = finding->space;
    struct vector at = position(finding->body);

    for (size_t i = 0; i < world->body_count; i++) {
        struct vector other = position(&world->bodies[i]);
        struct contact contact;

        if (&world->bodies[i] == finding->body || world->bodies[i].lifted)
            continue;
        capsule_meet_discs(at, other, space->body_radius_mm, &contact);
        if (is_far(space, &contact, space->body_radius_mm))
            continue;
        touch(finding, &contact, space->capsule_count + i);
        feel(finding, other, other, space->body_radius_mm);
    }
}

static int32_t ones(uint64_t word)
{
    int32_t count = 0;

    for (; word != 0; word &= word - 1)
        count++;
    return count;
}

static void count_touches(struct finding *finding, uint64_t *before)
{
    struct body *body = finding->body;

    body->touches = 0;
    for (size_t i = 0; i < finding->space->words; i++) {
        body->touches += ones(finding->touching[i]);
        body->collisions += ones(finding->touching[i] & ~before[i]);
        before[i] = finding->touching[i];
    }
}

/* Finds all that a body overlaps. */
static void find(struct world *world, struct body *body)
{
    struct plain_world *space = of(world);
    struct finding finding = {space, body, &space->touching[world->body_count * space->words]};

    body->feel = 0;
    for (unsigned n = 0; n < CONES; n++)
        body->overlaps[n] = 0;
    for (size_t i = 0; i < space->words; i++)
        finding.touching[i] = 0;
    if (!body->lifted) {
        meet_capsules(&finding, &space->places[index_of(world, body)]);
        meet_bodies(&finding, world);
    }
    count_touches(&finding, &space->touching[index_of(world, body) * space->words]);
}

/* Whether what a body overlaps may have changed with another one that has moved. */
static bool may_notice(const struct plain_world *space, const struct body *body, const struct plain_place *other)
{
    struct vector way = vector_to(position(body), other->at);
    double reach_mm = space->cones->reach_mm + space->body_radius_mm;

    return !body->lifted && !other->lifted && vector_dot(way, way) <= reach_mm * reach_mm;
}

/* How far a body may still go after a move. */
static double free_after(const struct plain_place *place, const struct body *body)
{
    struct vector way = vector_to(place->at, position(body));

    return place->free_mm - (way.x < 0.0 ? -way.x : way.x) - (way.y < 0.0 ? -way.y : way.y);
}

static void place(struct world *world, struct body *body)
{
    struct plain_world *space = of(world);
    struct plain_place *place = &space->places[index_of(world, body)];
    const struct plain_place before = *place, now = {position(body), body->lifted, free_after(place, body)};

    *place = now;
    find(world, body);
    for (size_t i = 0; i < world->body_count; i++) {
        struct body *other = &world->bodies[i];

        if (other != body && (may_notice(space, other, &before) || may_notice(space, other, &now)))
            find(world, other);
    }
}

static bool hides(const struct world *world, const struct body *body, struct vector point)
{
    const struct plain_world *space = of(world);
    struct vector from = position(body);

    for (size_t i = 0; i < space->capsule_count; i++)
        if (capsule_hides(&space->capsules[i], from, point))
            return true;
    for (size_t i = 0; i < world->body_count; i++) {
        const struct body *other = &world->bodies[i];

        if (other != body && !other->lifted && capsule_disc_hides(position(other), space->body_radius_mm, from, point))
            return true;
    }
    return false;
}

void plain_space_take(struct plain_world *space, struct world *world)
{
    space->space = (struct space){place, hides};
    world->space = &space->space;
    for (size_t i = 0; i < world->body_count; i++) {
        struct body *body = &world->bodies[i];
        int32_t collisions = body->collisions;

        space->places[i] = (struct plain_place){position(body), body->lifted, 0.0};
        find(world, body);
        body->collisions = collisions;
    }
}

void plain_space_settle(struct world *world)
{
    for (size_t i = 0; i < world->body_count; i++)
        of(world)->places[i].free_mm = 0.0;
    for (size_t i = 0; i < world->body_count; i++) {
        world->bodies[i].depth_mm = 0.0;
        place(world, &world->bodies[i]);
    }
}
