/* edits.h: changes to an arena between two ticks, by a person or a schedule. */
#ifndef OCTET_EDITS_H
#define OCTET_EDITS_H

#include "host_sim/world/native/draw/layout.h"
#include "host_sim/world/native/space/capsule.h"
#include "host_sim/world/native/world.h"

/* The obstacles of an arena. Bars and plants have ids 0, 1, ... in the order in which they are added. */

enum { FURNITURE_BARS_MAX = LAYOUT_BARS_MAX, FURNITURE_PLANTS_MAX = 20 };
enum { FURNITURE_CAPSULES_MAX = WALLS + FURNITURE_BARS_MAX + FURNITURE_PLANTS_MAX };

struct furniture {
    double width_mm;        /* of the arena */
    double height_mm;
    double bar_radius_mm;
    double body_radius_mm;
    size_t bar_count;
    size_t plant_count;
    struct bar bars[FURNITURE_BARS_MAX];
    struct plant plants[FURNITURE_PLANTS_MAX];
    uint32_t bar_ids[FURNITURE_BARS_MAX];
    uint32_t plant_ids[FURNITURE_PLANTS_MAX];
    uint32_t next_bar_id;
    uint32_t next_plant_id;
    size_t capsule_count;
    struct capsule capsules[FURNITURE_CAPSULES_MAX];   /* walls, bars and plants */
};

void furniture_set(struct furniture *furniture, const struct bar bars[], size_t count);
        /* Starts with these bars and nothing else; width_mm to body_radius_mm must be set already. */

void furniture_lay_out(struct furniture *furniture);
        /* Rebuilds the capsules after a change. */

struct obstacles furniture_obstacles(const struct furniture *furniture);
        /* The obstacles as draw/layout.h takes them. They point into it. */

enum { EDIT_BARS_MAX = 40, EDIT_PLANT_MIN_MM = 20, EDIT_PLANT_MAX_MM = 500, EDIT_TEXT_MAX = 256 };

/* The fields are those of run.world.json; robot.toml says which of them an edit has. */
struct edit {
    int32_t kind;      /* an enum edit_kind */
    uint32_t id;       /* of a bar, of a plant or of a piece of food */
    uint32_t robot;    /* from 0 */
    uint32_t seed;     /* of noise */
    struct vector a;   /* ends of a bar, mm */
    struct vector b;
    struct vector at;
    double heading;    /* mrad */
    double radius;     /* mm */
    char what[EDIT_TEXT_MAX];   /* as in body_faults_add */
};

const char *edit_make(struct furniture *furniture, struct world *world, const struct edit *edit);
        /* Makes one edit. Returns null, or why it is impossible, with nothing changed. Afterwards the caller must
           pass the capsules to the space and settle the world. */

#endif
