#include "octet_brain.h"

bool own_begin(struct brain *brain)
{
    (void)brain;
    return false;
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    if (pattern_of(senses->feel) == 0)
        return step(REASON_WANDER, config->value[STEP_MM]);
    return turn(REASON_TRIAL, any_side(brain), config->value[TRIAL_DEG]);
}
