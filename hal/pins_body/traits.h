/* traits.h: calibration of one robot: body_near_right and the parameters after it in octet.dbc. They are stored in
 * flash, in two records beside that of the memory; an interrupted store leaves each record old or new. */
#ifndef OCTET_TRAITS_H
#define OCTET_TRAITS_H

#include "firmware/io.h"

enum {
    TRAIT_FIRST = BODY_NEAR_RIGHT,
    TRAITS_KEPT = BODY_PARAMETER_END - TRAIT_FIRST,
    TRAIT_LIGHT = 16,          /* sensor counts per unit of body_near_.. */
    TRAIT_DEAD_OF = 8192, TRAIT_DEAD_BY = 125   /* this duty is 125 units of body_dead_.. */
};

struct traits {
    uint8_t value[TRAITS_KEPT];   /* by number, less TRAIT_FIRST */
};

bool traits_fit(uint8_t number, uint32_t value);
        /* Whether value is in the range of parameter number, BODY_MEASURE..BODY_PARAMETER_END - 1. */

void traits_load(struct traits *traits);
        /* Loads the stored values; those missing or out of range get the defaults of octet.dbc. */

int traits_store(const struct traits *traits);
        /* Returns 0, or HAL_E_STORE. May take a second: call only with the wheels at rest. */

#endif
