#include "host_sim/world/native/sight.h"
#include "host_sim/world/native/vector_sums.h"

/* Distance to food within the corridor, whole mm; 0 for food outside it. */
static int32_t distance_mm(const struct world *world, const struct body *body, const struct food *food)
{
    struct vector way = {food->x_mm - body->x_mm, food->y_mm - body->y_mm};
    double aside_mm = way.y * body->ahead.x - way.x * body->ahead.y, half_mm = world->params.beam_width_mm / 2;
    double whole_mm;

    if (aside_mm > half_mm || aside_mm < -half_mm || vector_dot(way, body->ahead) <= 0.0)
        return 0;
    whole_mm = vector_whole(vector_length(way));
    return whole_mm < 1.0 ? 1 : (int32_t)whole_mm;
}

void sight_look(const struct world *world, struct body *body)
{
    body->seen = -1;
    body->seen_mm = 0;
    for (size_t i = 0; i < world->food_count && !body->lifted; i++) {
        const struct food *food = &world->food[i];
        int32_t far_mm = food->eaten ? 0 : distance_mm(world, body, food);
        struct vector at = {food->x_mm, food->y_mm};

        if (far_mm > 0 && (body->seen < 0 || far_mm < body->seen_mm) && !world->space->hides(world, body, at)) {
            body->seen = (int32_t)i;
            body->seen_mm = far_mm;
        }
    }
}
