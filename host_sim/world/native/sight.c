#include "host_sim/world/native/sight.h"
#include "host_sim/world/native/kit/kit.h"
#include "host_sim/world/native/vector_sums.h"

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
