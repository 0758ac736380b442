/* calibration_values.h: calibration of one robot: body_near_right and the parameters after it in octet.dbc. They are
 * stored in flash, in two records beside that of the memory; an interrupted store leaves each record old or new. */
#ifndef OCTET_CALIBRATION_VALUES_H
#define OCTET_CALIBRATION_VALUES_H

#include "firmware/io.h"

enum {
    CALIBRATION_FIRST = BODY_NEAR_RIGHT,
    CALIBRATION_VALUES = BODY_PARAMETER_END - CALIBRATION_FIRST,
    CALIBRATION_LIGHT = 16,    /* sensor counts per unit of body_near_.. */
    CALIBRATION_DEAD_OF = 8192, CALIBRATION_DEAD_BY = 125   /* this duty is 125 units of body_dead_.. */
};

struct calibration_values {
    uint8_t value[CALIBRATION_VALUES];   /* by number, less CALIBRATION_FIRST */
};

bool calibration_fit(uint8_t number, uint32_t value);
        /* Whether value is in the range of parameter number, BODY_MEASURE..BODY_PARAMETER_END - 1. */

void calibration_load(struct calibration_values *values);
        /* Loads the stored values; those missing or out of range get the defaults of octet.dbc. */

int calibration_store(const struct calibration_values *values);
        /* Returns 0, or HAL_E_STORE. May take a second: call only with the wheels at rest. */

#endif
