#include "octet_brain.h"

bool own_begin(struct brain *brain)
{
    (void)brain;
    return false;
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    (void)brain;
    if (senses->feel & FEEL_FRONT_RIGHT)
        return turn(REASON_PROGRAM, SIDE_LEFT, config->value[TURN_DEG]);
    return step(REASON_WANDER, config->value[STEP_MM]);
}
