#include "octet_brain.h"

static const enum side TABLE[8] = {
    SIDE_NOTHING, SIDE_LEFT, SIDE_LEFT, SIDE_LEFT, SIDE_RIGHT, SIDE_LEFT, SIDE_RIGHT, SIDE_LEFT,
};

bool own_begin(struct brain *brain)
{
    (void)brain;
    return false;
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    enum side side = TABLE[pattern_of(senses->feel)];

    (void)brain;
    if (side == SIDE_NOTHING)
        return step(REASON_WANDER, config->value[STEP_MM]);
    return turn(REASON_PROGRAM, side, config->value[TURN_DEG]);
}
