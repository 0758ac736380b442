#include "host_sim/world/native/sight.h"

#include <math.h>

static bool is_hidden(const struct world *world, const struct body *body, const struct food *food)
{
    struct munk_vector from = {body->x_mm, body->y_mm}, to = {food->x_mm, food->y_mm};
    struct munk_hit hit;

    return world->munk->cpSpaceSegmentQueryFirst(world->space, from, to, 0.0, body->sight, &hit) != NULL;
}

/* Distance to food within the corridor, whole mm; 0 for food outside it. */
static int32_t distance_mm(const struct world *world, const struct body *body, const struct food *food)
{
    double dx = food->x_mm - body->x_mm, dy = food->y_mm - body->y_mm;
    double ahead_x = cos(body->heading_rad), ahead_y = sin(body->heading_rad);
    double whole_mm;

    if (dx * ahead_x + dy * ahead_y <= 0.0 || fabs(dy * ahead_x - dx * ahead_y) > world->params.beam_width_mm / 2)
        return 0;
    whole_mm = rint(sqrt(dx * dx + dy * dy));
    return whole_mm < 1.0 ? 1 : (int32_t)whole_mm;
}

void sight_look(const struct world *world, struct body *body)
{
    body->seen = -1;
    body->seen_mm = 0;
    for (size_t i = 0; i < world->food_count && !body->lifted; i++) {
        const struct food *food = &world->food[i];
        int32_t far_mm = food->eaten ? 0 : distance_mm(world, body, food);

        if (far_mm > 0 && (body->seen < 0 || far_mm < body->seen_mm) && !is_hidden(world, body, food)) {
            body->seen = (int32_t)i;
            body->seen_mm = far_mm;
        }
    }
}
