#include "host_sim/world/native/space/plain_view.h"

#include "host_sim/world/native/space/plain_near.h"
#include "host_sim/world/native/vector_sums.h"

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
