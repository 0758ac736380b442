#include "host_sim/world/native/world.h"

#include "host_sim/world/native/body.h"
#include "host_sim/world/native/kit/kit.h"
#include "host_sim/world/native/sight.h"
#include "host_sim/world/native/vector_sums.h"

void world_begin(struct world *world)
{
    for (size_t i = 0; i < world->body_count; i++)
        body_face(&world->bodies[i]);
}

void world_settle(struct world *world)
{
    world_begin(world);
    for (size_t i = 0; i < world->body_count; i++)
        body_place(world, &world->bodies[i]);
}

/* A wheel's odometer after a distance. */
static uint16_t odometer(double rolled_mm)
{
    return (uint16_t)((long long)vector_whole(rolled_mm * ODOMETER_COUNTS_PER_MM) & (ODOMETER_SPAN - 1));
}

void world_sense(struct world *world, struct body *body, uint32_t tick, struct senses *out)
{
    sight_look(world, body);
    out->tick = (uint8_t)(tick % TICK_SPAN);
    out->feel = body->feel;
    out->bump = body->touches > 0;
    out->look = body->seen_mm > 0;
    out->beacon_mm = (uint16_t)body->seen_mm;
    out->odometer_left = odometer(body->left_mm);
    out->odometer_right = odometer(body->right_mm);
    for (unsigned n = 0; n < FEEL_COUNT; n++)
        out->range_mm[n] = RANGE_NONE;
    if (body->kit)
        kit_sense(body->kit, world, body, tick, out);
    body_faults_sense(&body->faults, tick, out);
}

void world_measure(struct world *world, struct body *body, uint32_t tick, const struct ranges *ideal,
                   uint8_t *range_mm)
{
    struct senses senses;

    if (body->kit && body->kit->senses_differ) {
        world_sense(world, body, tick, &senses);
        for (unsigned n = 0; n < FEEL_COUNT; n++)
            range_mm[n] = senses.range_mm[n];
    } else {
        ranges_measure(ideal, world, body, range_mm);
    }
    body_faults_measure(&body->faults, range_mm);
}

bool world_eat(struct world *world, struct body *body)
{
    struct food *food = body->seen < 0 ? NULL : &world->food[body->seen];

    if (!food || food->eaten || body->seen_mm >= world->params.eat_reach_mm)
        return false;
    food->eaten = true;
    return true;
}

double world_way_mm(const struct world *world, double speed_mm_s)
{
    double limit = world->params.max_wheel_speed_mm_s;

    return (speed_mm_s > limit ? limit : speed_mm_s < -limit ? -limit : speed_mm_s) * world->params.tick_s;
}

void world_move(struct world *world, struct body *body, double left_mm_s, double right_mm_s)
{
    double rolled_mm[KIT_WHEELS], counted_mm[KIT_WHEELS], track_mm = world->params.wheel_track_mm;
    struct vector before = {body->x_mm, body->y_mm};

    body_faults_drive(&body->faults, &left_mm_s, &right_mm_s);
    counted_mm[0] = rolled_mm[0] = world_way_mm(world, left_mm_s);
    counted_mm[1] = rolled_mm[1] = world_way_mm(world, right_mm_s);
    if (body->kit)
        track_mm *= kit_roll(body->kit, world->params.tick_s, counted_mm, rolled_mm);
    body_faults_count(&body->faults, &counted_mm[0], &counted_mm[1]);
    body->left_mm += counted_mm[0];
    body->right_mm += counted_mm[1];
    if (body->lifted)
        return;
    body_roll(body, rolled_mm[0], rolled_mm[1], track_mm);
    body_place(world, body);
    body_push_out(world, body, before);
}

size_t world_food_left(const struct world *world)
{
    size_t left = 0;

    for (size_t i = 0; i < world->food_count; i++)
        left += !world->food[i].eaten;
    return left;
}
