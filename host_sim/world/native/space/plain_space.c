#include "host_sim/world/native/space/plain_space.h"

#include "host_sim/world/native/space/plain_near.h"
#include "host_sim/world/native/vector_sums.h"

static const double MARGIN_MM = 0.001;   /* far more than rounding */
static const double FREE_MAX_MM = 1e6;

static size_t index_of(const struct world *world, const struct body *body)
{
    return (size_t)(body - world->bodies);
}

/* What has been found about one body so far. */
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

/* A point relative to a body. */
static struct vector seen_from(const struct body *body, struct vector point)
{
    struct vector way = vector_to(plain_position(body), point);

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

/* How far a body may move before it could sense an obstacle at this distance. */
static double way_to(const struct plain_world *space, double apart_mm)
{
    return apart_mm - space->cones->reach_mm - MARGIN_MM;
}

/* Checks one capsule. Returns a lower bound of its distance. */
static double meet_capsule(struct finding *finding, size_t number)
{
    const struct plain_world *space = finding->space;
    const struct capsule *capsule = &space->capsules[number];
    double apart_mm = capsule_apart_mm(capsule, plain_position(finding->body));
    struct contact contact;

    if (apart_mm > space->cones->reach_mm)
        return apart_mm;
    capsule_meet_disc(capsule, plain_position(finding->body), space->body_radius_mm, &contact);
    if (is_far(space, &contact, capsule->radius_mm))
        return vector_root(contact.apart_mm2) - capsule->radius_mm;
    touch(finding, &contact, number);
    feel(finding, capsule->a, capsule->b, capsule->radius_mm);
    return 0.0;
}

/* Checks the capsules near a body. Returns how far the body may move before it could sense another one. */
static double meet_capsules(struct finding *finding)
{
    const struct plain_world *space = finding->space;
    struct vector at = plain_position(finding->body);
    const struct plain_choice near = plain_near_capsules(space, at);
    double free_mm = space->grid ? plain_grid_border_mm(space->grid, at) - MARGIN_MM : FREE_MAX_MM;

    for (size_t i = 0; i < near.count; i++) {
        double way_mm = way_to(space, meet_capsule(finding, plain_chosen(&near, i)));

        if (way_mm < free_mm)
            free_mm = way_mm;
    }
    return free_mm;
}

static void meet_body(struct finding *finding, const struct body *other, size_t number)
{
    const struct plain_world *space = finding->space;
    struct vector at = plain_position(other);
    struct contact contact;

    if (other == finding->body || other->lifted)
        return;
    capsule_meet_discs(plain_position(finding->body), at, space->body_radius_mm, &contact);
    if (is_far(space, &contact, space->body_radius_mm))
        return;
    touch(finding, &contact, space->capsule_count + number);
    feel(finding, at, at, space->body_radius_mm);
}

static void meet_bodies(struct finding *finding, const struct world *world)
{
    uint32_t near[PLAIN_NEAR_MAX];
    size_t count = world->body_count > 1 ? plain_near_bodies(world, plain_position(finding->body), near) : 0;

    for (size_t i = 0; i < count; i++)
        meet_body(finding, &world->bodies[near[i]], near[i]);
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
    struct plain_world *space = plain_world_of(world);
    struct plain_place *place = &space->places[index_of(world, body)];
    struct finding finding = {space, body, &space->touching[world->body_count * space->words]};

    body->feel = 0;
    for (unsigned n = 0; n < CONES; n++)
        body->overlaps[n] = 0;
    for (size_t i = 0; i < space->words; i++)
        finding.touching[i] = 0;
    if (!body->lifted) {
        if (place->free_mm <= 0.0)
            place->free_mm = meet_capsules(&finding);
        meet_bodies(&finding, world);
    }
    count_touches(&finding, &space->touching[index_of(world, body) * space->words]);
}

/* Whether what a body overlaps may include another one at this place. */
static bool may_notice(const struct plain_world *space, const struct body *body, const struct plain_place *other)
{
    struct vector way = vector_to(plain_position(body), other->at);
    double reach_mm = space->cones->reach_mm + space->body_radius_mm;

    return !body->lifted && !other->lifted && vector_dot(way, way) <= reach_mm * reach_mm;
}

/* How far a body may still move after a move. */
static double free_after(const struct plain_place *place, const struct body *body)
{
    struct vector way = vector_to(place->at, plain_position(body));

    return place->free_mm - (way.x < 0.0 ? -way.x : way.x) - (way.y < 0.0 ? -way.y : way.y);
}

/* Updates the other bodies that may sense a body's move. */
static void tell_others(struct world *world, const struct body *body, const struct plain_place *before)
{
    struct plain_world *space = plain_world_of(world);
    const struct plain_place *now = &space->places[index_of(world, body)];
    uint32_t near[PLAIN_NEAR_MAX];
    size_t count = plain_near_bodies(world, now->at, near);

    for (size_t i = 0; i < count; i++) {
        struct body *other = &world->bodies[near[i]];

        if (other != body && (may_notice(space, other, before) || may_notice(space, other, now)))
            find(world, other);
    }
}

static void place(struct world *world, struct body *body)
{
    struct plain_world *space = plain_world_of(world);
    struct plain_place *place = &space->places[index_of(world, body)];
    const struct plain_place before = *place;

    place->free_mm = free_after(place, body);
    place->at = plain_position(body);
    place->lifted = body->lifted;
    if (space->grid)
        plain_grid_put(space->grid, (uint32_t)index_of(world, body), place->at);
    if (world->body_count == 1 && place->free_mm > 0.0)
        return;   /* no other body, and still nothing in range */
    find(world, body);
    if (world->body_count > 1)
        tell_others(world, body, &before);
}

void plain_space_take(struct plain_world *space, struct world *world)
{
    space->space = (struct space){place, plain_view_hides};
    space->words = PLAIN_WORDS(space->capsule_count + world->body_count);
    world->space = &space->space;
    for (size_t i = 0; i < space->words * (world->body_count + 1); i++)
        space->touching[i] = 0;
    for (size_t i = 0; i < world->body_count; i++) {
        const struct body *body = &world->bodies[i];

        space->places[i] = (struct plain_place){plain_position(body), body->lifted, 0.0};
        if (space->grid)
            plain_grid_put(space->grid, (uint32_t)i, plain_position(body));
    }
    for (size_t i = 0; i < world->body_count; i++) {
        struct body *body = &world->bodies[i];
        int32_t collisions = body->collisions;

        find(world, body);
        body->collisions = collisions;
    }
}
