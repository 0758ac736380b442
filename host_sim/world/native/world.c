#include "host_sim/world/native/world.h"

#include "host_sim/world/native/kit/kit.h"
#include "host_sim/world/native/trig.h"
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

static const double TAU = 6.283185307179586476925286766559;
/* How deep a body that is pushed out stays in the obstacle, so that it keeps touching and does not bounce. */
static const double TOUCH_MM = 0.01;

enum { PUSHES = 8 };

void body_face(struct body *body)
{
    body->ahead_rad = body->heading_rad;
    body->ahead = trig_along(body->heading_rad);
}

/* Wraps an angle to -pi..pi. Up to 3 pi the result equals that of remainder() to the last bit. */
static double within_half_a_turn(double angle_rad)
{
    while (angle_rad > TAU / 2)
        angle_rad -= TAU;
    while (angle_rad < -TAU / 2)
        angle_rad += TAU;
    return angle_rad;
}

void body_roll(struct body *body, double left_mm, double right_mm, double track_mm)
{
    double turn = (left_mm - right_mm) / track_mm, way_mm = (left_mm + right_mm) / 2;
    double half = turn / 2, square = half * half;
    /* Taylor series of sin(x)/x and cos(x), for angles that a body can turn in a tick. */
    double part = 1.0 + square * (-1.0 / 6 + square * (1.0 / 120 + square * (-1.0 / 5040 + square * (1.0 / 362880))));
    double cosine = 1.0 + square * (-1.0 / 2 + square * (1.0 / 24 + square * (-1.0 / 720 + square * (1.0 / 40320))));
    double sine = half * part, chord_mm = way_mm * part;
    struct vector along = {body->ahead.x * cosine - body->ahead.y * sine,
                           body->ahead.y * cosine + body->ahead.x * sine};

    body->x_mm += chord_mm * along.x;
    body->y_mm += chord_mm * along.y;
    body->heading_rad = within_half_a_turn(body->heading_rad + turn);
    if (body->heading_rad != body->ahead_rad)
        body_face(body);
}

void body_place(struct world *world, struct body *body)
{
    body->depth_mm = 0.0;
    world->space->place(world, body);
}

void body_push_out(struct world *world, struct body *body, struct vector before)
{
    for (unsigned i = 0; i < PUSHES && body->depth_mm > TOUCH_MM; i++) {
        double push_mm = body->depth_mm - TOUCH_MM / 2;

        body->x_mm -= push_mm * body->normal.x;
        body->y_mm -= push_mm * body->normal.y;
        body_place(world, body);
    }
    if (body->depth_mm > TOUCH_MM) {
        body->x_mm = before.x;
        body->y_mm = before.y;
        body_place(world, body);
    }
}

static const double FAR_MM = 8191.0;   /* the most that a message can hold: farther food is not seen */

static struct vector way_to(const struct body *body, const struct food *food)
{
    return (struct vector){food->x_mm - body->x_mm, food->y_mm - body->y_mm};
}

/* Whether food is in the beam, ahead or behind: checked first, because it seldom is. */
static bool is_in_line(const struct world *world, const struct body *body, const struct food *food)
{
    struct vector way = way_to(body, food);
    double aside_mm = way.y * body->ahead.x - way.x * body->ahead.y, beam_mm = world->params.beam_width_mm;

    if (body->kit)
        return kit_sees(body->kit, vector_dot(way, body->ahead), aside_mm, beam_mm);
    return __builtin_fabs(aside_mm) <= beam_mm / 2;
}

/* Distance to food in the beam, whole mm; 0 for food that is eaten, behind or too far away. */
static int32_t distance_mm(const struct body *body, const struct food *food)
{
    struct vector way = way_to(body, food);
    double whole_mm;

    if (food->eaten || vector_dot(way, body->ahead) <= 0.0)
        return 0;
    whole_mm = vector_whole(vector_length(way));
    if (whole_mm > FAR_MM)
        return 0;
    return whole_mm < 1.0 ? 1 : (int32_t)whole_mm;
}

/* Notes a piece of food if it is nearer than the one seen so far and nothing hides it. */
static void look_at(const struct world *world, struct body *body, size_t number)
{
    const struct food *food = &world->food[number];
    int32_t far_mm = distance_mm(body, food);
    struct vector at = {food->x_mm, food->y_mm};

    if (far_mm > 0 && (body->seen < 0 || far_mm < body->seen_mm) && !world->space->hides(world, body, at)) {
        body->seen = (int32_t)number;
        body->seen_mm = far_mm;
    }
}

void sight_look(const struct world *world, struct body *body)
{
    body->seen = -1;
    body->seen_mm = 0;
    for (size_t i = 0; i < world->food_count && !body->lifted; i++)
        if (is_in_line(world, body, &world->food[i]))
            look_at(world, body, i);
}
