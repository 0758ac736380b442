/* config.h: the numbers that a robot is set up with, each with its range, and the profiles that name sets of them. */
#ifndef OCTET_CONFIG_H
#define OCTET_CONFIG_H

#include "firmware/io.h"

struct config {
    uint8_t value[PARAMETER_COUNT];
};

bool config_load(struct config *config, uint8_t profile);
        /* Sets all parameters as the profile has them. False, and nothing is changed, if there is no such profile. */

bool config_fits(uint8_t parameter, uint32_t value);
        /* Is value within the range of parameter 0..PARAMETER_COUNT-1? */

void config_set(struct config *config, uint8_t parameter, uint8_t value);
        /* Sets a parameter to a value that fits. */

#endif
