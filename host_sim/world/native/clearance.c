#include "host_sim/world/native/clearance.h"
#include "host_sim/world/native/trig.h"

#include <math.h>

static const double DOUBT = 1e-9;   /* of a squared distance: far more than rounding, far less than matters */

static double lesser(double a, double b)
{
    return a < b ? a : b;
}

static double walls_mm(const struct obstacles *obstacles, struct vector at)
{
    return lesser(lesser(at.x, obstacles->width_mm - at.x), lesser(at.y, obstacles->height_mm - at.y));
}

/* Vector from the nearest point of a bar's centre line to a point. */
static struct vector off_line(const struct bar *bar, struct vector at)
{
    double dx = bar->b.x - bar->a.x, dy = bar->b.y - bar->a.y;
    double along = ((at.x - bar->a.x) * dx + (at.y - bar->a.y) * dy) / (dx * dx + dy * dy);
    double inside = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;

    return (struct vector){at.x - bar->a.x - inside * dx, at.y - bar->a.y - inside * dy};
}

static struct vector off_plant(const struct plant *plant, struct vector at)
{
    return (struct vector){at.x - plant->at.x, at.y - plant->at.y};
}

static double beyond_mm(struct vector off, double radius_mm)
{
    return trig_hypot(off.x, off.y) - radius_mm;
}

double clearance_mm(const struct obstacles *obstacles, struct vector at)
{
    double nearest = walls_mm(obstacles, at);

    for (size_t i = 0; i < obstacles->bar_count; i++)
        nearest = lesser(nearest, beyond_mm(off_line(&obstacles->bars[i], at), obstacles->bar_radius_mm));
    for (size_t i = 0; i < obstacles->plant_count; i++)
        nearest = lesser(nearest, beyond_mm(off_plant(&obstacles->plants[i], at), obstacles->plants[i].radius_mm));
    return nearest;
}

/* Computes the square root only where it could change the answer. */
static bool is_clear(struct vector off, double radius_mm, double room_mm)
{
    double squared = off.x * off.x + off.y * off.y, limit = (room_mm + radius_mm) * (room_mm + radius_mm);

    if (squared > limit * (1.0 + DOUBT))
        return true;
    return squared >= limit * (1.0 - DOUBT) && beyond_mm(off, radius_mm) >= room_mm;
}

bool clearance_suffices(const struct obstacles *obstacles, struct vector at, double room_mm)
{
    if (walls_mm(obstacles, at) < room_mm)
        return false;
    for (size_t i = 0; i < obstacles->bar_count; i++)
        if (!is_clear(off_line(&obstacles->bars[i], at), obstacles->bar_radius_mm, room_mm))
            return false;
    for (size_t i = 0; i < obstacles->plant_count; i++)
        if (!is_clear(off_plant(&obstacles->plants[i], at), obstacles->plants[i].radius_mm, room_mm))
            return false;
    return true;
}
