#include "host_sim/world/native/edits.h"

#include "host_sim/world/native/kit/kit.h"
#include "host_sim/world/native/vector_sums.h"

/* The arena that is edited. */
struct arena {
    struct furniture *furniture;
    struct world *world;
};

static const char NO_NUMBER[] = "there is no such number";
static const char OUTSIDE[] = "that is outside of the arena";
static const char STANDS_THERE[] = "the robot stands there";

static double apart_mm(struct vector one, struct vector other)
{
    return vector_length(vector_to(one, other));
}

static bool is_inside(const struct arena *arena, struct vector at)
{
    return at.x >= 0 && at.x <= arena->furniture->width_mm && at.y >= 0 && at.y <= arena->furniture->height_mm;
}

/* Index of an id in a list; `count` if it is not there. */
static size_t place_of(const uint32_t ids[], size_t count, uint32_t id)
{
    size_t place = 0;

    while (place < count && ids[place] != id)
        place++;
    return place;
}

/* Whether these obstacles overlap a robot that stands on the floor. */
static bool is_on_robot(const struct arena *arena, const struct obstacles *obstacles)
{
    for (size_t i = 0; i < arena->world->body_count; i++) {
        const struct body *body = &arena->world->bodies[i];

        if (!body->lifted
            && clearance_mm(obstacles, (struct vector){body->x_mm, body->y_mm}) < arena->furniture->body_radius_mm)
            return true;
    }
    return false;
}

/* Places a bar. One that robots push may touch them. */
static const char *put_bar(const struct arena *arena, size_t place, const struct edit *edit)
{
    struct bar bar = {edit->a, edit->b};
    struct obstacles alone = furniture_obstacles(arena->furniture);

    alone.bars = &bar;
    alone.bar_count = 1;
    alone.plant_count = 0;
    if (!is_inside(arena, bar.a) || !is_inside(arena, bar.b))
        return OUTSIDE;
    if (apart_mm(bar.a, bar.b) < 2 * arena->furniture->bar_radius_mm)
        return "the obstacle is too short";
    if (edit->kind != EDIT_KIND_PUSH_BAR && is_on_robot(arena, &alone))
        return STANDS_THERE;
    arena->furniture->bars[place] = bar;
    return NULL;
}

static const char *add_bar(const struct arena *arena, const struct edit *edit)
{
    struct furniture *furniture = arena->furniture;
    const char *why = furniture->bar_count < EDIT_BARS_MAX ? put_bar(arena, furniture->bar_count, edit)
                                                           : "there are 40 obstacles already";

    if (!why)
        furniture->bar_ids[furniture->bar_count++] = furniture->next_bar_id++;
    return why;
}

static const char *move_bar(const struct arena *arena, const struct edit *edit)
{
    size_t place = place_of(arena->furniture->bar_ids, arena->furniture->bar_count, edit->id);

    return place == arena->furniture->bar_count ? NO_NUMBER : put_bar(arena, place, edit);
}

static const char *remove_bar(struct furniture *furniture, uint32_t id)
{
    size_t place = place_of(furniture->bar_ids, furniture->bar_count, id);

    if (place == furniture->bar_count)
        return NO_NUMBER;
    furniture->bar_count--;
    for (size_t i = place; i < furniture->bar_count; i++) {
        furniture->bars[i] = furniture->bars[i + 1];
        furniture->bar_ids[i] = furniture->bar_ids[i + 1];
    }
    return NULL;
}

static const char *put_plant(const struct arena *arena, size_t place, struct plant plant)
{
    struct obstacles alone = furniture_obstacles(arena->furniture);

    alone.plants = &plant;
    alone.plant_count = 1;
    alone.bar_count = 0;
    if (!is_inside(arena, plant.at))
        return OUTSIDE;
    if (plant.radius_mm < EDIT_PLANT_MIN_MM || plant.radius_mm > EDIT_PLANT_MAX_MM)
        return "a plant has a radius of 20 to 500 mm";
    if (is_on_robot(arena, &alone))
        return STANDS_THERE;
    arena->furniture->plants[place] = plant;
    return NULL;
}

static const char *add_plant(const struct arena *arena, struct plant plant)
{
    struct furniture *furniture = arena->furniture;
    const char *why = furniture->plant_count < FURNITURE_PLANTS_MAX ? put_plant(arena, furniture->plant_count, plant)
                                                                    : "there are 20 plants already";

    if (!why)
        furniture->plant_ids[furniture->plant_count++] = furniture->next_plant_id++;
    return why;
}

/* Moves a plant, lets it grow, or removes it. */
static const char *change_plant(const struct arena *arena, const struct edit *edit)
{
    struct furniture *furniture = arena->furniture;
    size_t place = place_of(furniture->plant_ids, furniture->plant_count, edit->id);
    struct plant *plant = furniture->plants + place;

    if (place == furniture->plant_count)
        return NO_NUMBER;
    if (edit->kind == EDIT_KIND_MOVE_PLANT)
        return put_plant(arena, place, (struct plant){edit->at, plant->radius_mm});
    if (edit->kind == EDIT_KIND_GROW_PLANT)
        return put_plant(arena, place, (struct plant){plant->at, edit->radius});
    furniture->plant_count--;
    for (size_t i = place; i < furniture->plant_count; i++) {
        furniture->plants[i] = furniture->plants[i + 1];
        furniture->plant_ids[i] = furniture->plant_ids[i + 1];
    }
    return NULL;
}

static const char *move_food(const struct arena *arena, uint32_t id, struct vector at)
{
    if (id >= arena->world->food_count)
        return NO_NUMBER;
    if (!is_inside(arena, at))
        return OUTSIDE;
    arena->world->food[id].x_mm = at.x;
    arena->world->food[id].y_mm = at.y;
    return NULL;
}

static bool has_room(const struct arena *arena, struct vector at)
{
    const struct obstacles obstacles = furniture_obstacles(arena->furniture);
    double radius_mm = arena->furniture->body_radius_mm;

    for (size_t i = 0; i < arena->world->body_count; i++) {
        const struct body *other = &arena->world->bodies[i];

        if (!other->lifted && apart_mm(at, (struct vector){other->x_mm, other->y_mm}) - radius_mm < radius_mm)
            return false;
    }
    return clearance_mm(&obstacles, at) >= radius_mm;
}

static const char *put(const struct arena *arena, const struct edit *edit)
{
    struct body *body = &arena->world->bodies[edit->robot];

    if (!body->lifted)
        return "the robot is not in the air";
    if (!has_room(arena, edit->at))
        return "there is no room for the robot";
    body->x_mm = edit->at.x;
    body->y_mm = edit->at.y;
    body->heading_rad = edit->heading / 1000;
    body->lifted = false;
    return NULL;
}

static const char *change_body(struct body *body, const struct edit *edit)
{
    const char *why = body_faults_add(&body->faults, edit->what, edit->seed, edit->robot);

    if (!why && body->kit)
        kit_suffer(body->kit, &body->faults);
    return why;
}

static const char *change_robot(const struct arena *arena, const struct edit *edit)
{
    struct body *body = arena->world->bodies;

    if (edit->robot >= arena->world->body_count)
        return "there is no such robot";
    body += edit->robot;
    if (edit->kind == EDIT_KIND_BODY)
        return change_body(body, edit);
    if (edit->kind == EDIT_KIND_PUT)
        return put(arena, edit);
    if (body->lifted)
        return "the robot is in the air already";
    body->lifted = true;
    return NULL;
}

static const char *make(const struct arena *arena, const struct edit *edit)
{
    switch (edit->kind) {
    case EDIT_KIND_ADD_BAR:
        return add_bar(arena, edit);
    case EDIT_KIND_MOVE_BAR:
    case EDIT_KIND_PUSH_BAR:
        return move_bar(arena, edit);
    case EDIT_KIND_REMOVE_BAR:
        return remove_bar(arena->furniture, edit->id);
    case EDIT_KIND_MOVE_FOOD:
        return move_food(arena, edit->id, edit->at);
    case EDIT_KIND_PLANT:
        return add_plant(arena, (struct plant){edit->at, edit->radius});
    case EDIT_KIND_MOVE_PLANT:
    case EDIT_KIND_GROW_PLANT:
    case EDIT_KIND_REMOVE_PLANT:
        return change_plant(arena, edit);
    default:
        return change_robot(arena, edit);
    }
}

const char *edit_make(struct furniture *furniture, struct world *world, const struct edit *edit)
{
    const struct arena arena = {furniture, world};
    const char *why = make(&arena, edit);

    if (!why)
        furniture_lay_out(furniture);
    return why;
}

void furniture_set(struct furniture *furniture, const struct bar bars[], size_t count)
{
    furniture->bar_count = count;
    furniture->plant_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        furniture->bars[i] = bars[i];
        furniture->bar_ids[i] = i;
    }
    furniture->next_bar_id = (uint32_t)count;
    furniture->next_plant_id = 0;
    furniture_lay_out(furniture);
}

void furniture_lay_out(struct furniture *furniture)
{
    struct capsule *at = furniture->capsules + WALLS;

    capsule_set_walls(furniture->capsules, furniture->width_mm, furniture->height_mm);
    for (size_t i = 0; i < furniture->bar_count; i++)
        capsule_set(at++, furniture->bars[i].a, furniture->bars[i].b, furniture->bar_radius_mm);
    for (size_t i = 0; i < furniture->plant_count; i++)
        capsule_set(at++, furniture->plants[i].at, furniture->plants[i].at, furniture->plants[i].radius_mm);
    furniture->capsule_count = (size_t)(at - furniture->capsules);
}

struct obstacles furniture_obstacles(const struct furniture *furniture)
{
    return (struct obstacles){
        .width_mm = furniture->width_mm,
        .height_mm = furniture->height_mm,
        .bar_radius_mm = furniture->bar_radius_mm,
        .bar_count = furniture->bar_count,
        .plant_count = furniture->plant_count,
        .bars = furniture->bars,
        .plants = furniture->plants,
    };
}
