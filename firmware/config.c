#include "firmware/config.h"

/* A byte holds each: that keeps the robot small. */
#define RANGE(parameter, minimum, maximum, initial) [parameter] = {minimum, maximum},

static const struct {
    uint8_t min, max;
} ranges[PARAMETER_COUNT] = {ROBOT_PARAMETERS(RANGE)};

#define INITIAL(parameter, minimum, maximum, initial) [parameter] = initial,

static const struct config defaults = {{ROBOT_PARAMETERS(INITIAL)}};

void config_reset(struct config *config)
{
    *config = defaults;
}

bool config_fits(uint8_t parameter, uint32_t value)
{
    return value >= ranges[parameter].min && value <= ranges[parameter].max;
}
