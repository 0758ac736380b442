/* traits.h: in what a robot differs from others of its plan, as it was calibrated: body_near_right and those behind it in octet.dbc.
 * They are kept in flash, in two records beside that of the memory: an interrupted store leaves each as it was or as it is to be. */
#ifndef OCTET_TRAITS_H
#define OCTET_TRAITS_H

#include "firmware/io.h"

enum {
    TRAIT_FIRST = BODY_NEAR_RIGHT,
    TRAITS_KEPT = BODY_PARAMETER_END - TRAIT_FIRST,
    TRAIT_LIGHT = 16,          /* of what the sensors measure, a unit of body_near_.. */
    TRAIT_DEAD_OF = 8192, TRAIT_DEAD_BY = 125   /* a duty of that: 125 units of body_dead_.. */
};

struct traits {
    uint8_t value[TRAITS_KEPT];   /* by number, less TRAIT_FIRST */
};

bool traits_fit(uint8_t number, uint32_t value);
        /* Whether parameter number TRAIT_FIRST..BODY_PARAMETER_END - 1 may have it. */

void traits_load(struct traits *traits);
        /* As they were stored last; what was not, or cannot be, is as in octet.dbc. */

int traits_store(const struct traits *traits);
        /* 0, or HAL_E_STORE. The wheels are at rest: it may take a second. */

#endif
