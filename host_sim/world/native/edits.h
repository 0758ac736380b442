/* edits.h: changes to an arena between two ticks, by a person or a schedule. */
#ifndef OCTET_EDITS_H
#define OCTET_EDITS_H

#include "host_sim/world/native/furniture.h"
#include "host_sim/world/native/world.h"

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
