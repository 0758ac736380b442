/* config.h: the robot's parameters, with the ranges and defaults of octet.dbc. */
#ifndef OCTET_CONFIG_H
#define OCTET_CONFIG_H

#include "firmware/io.h"

struct config {
    uint8_t value[PARAMETER_COUNT];
};

void config_reset(struct config *config);
        /* Sets all parameters to their defaults. */

bool config_fits(uint8_t parameter, uint32_t value);
        /* Whether value is within the range of parameter 0..PARAMETER_COUNT-1. */

#endif
