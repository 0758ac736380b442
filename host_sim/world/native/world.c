#include "host_sim/world/native/world.h"

#include "host_sim/world/native/body.h"
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

/* The wheel's counter after a distance. */
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
    body_faults_sense(&body->faults, tick, out);
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
    double left_mm, right_mm, left_counted_mm, right_counted_mm;
    struct vector before = {body->x_mm, body->y_mm};

    body_faults_drive(&body->faults, &left_mm_s, &right_mm_s);
    left_counted_mm = left_mm = world_way_mm(world, left_mm_s);
    right_counted_mm = right_mm = world_way_mm(world, right_mm_s);
    body_faults_count(&body->faults, &left_counted_mm, &right_counted_mm);
    body->left_mm += left_counted_mm;
    body->right_mm += right_counted_mm;
    if (body->lifted)
        return;
    body_roll(body, left_mm, right_mm, world->params.wheel_track_mm);
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
