#include "octet_brain.h"

bool own_begin(struct brain *brain)
{
    (void)brain;
    return false;
}

static int count(uint8_t pattern)
{
    int sum = 0;

    for (; pattern; pattern >>= 1)
        sum += pattern & 1;
    return sum;
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    int triggered = count(pattern_of(senses->feel));

    (void)brain;
    if (triggered == 0)
        return step(REASON_WANDER, config->value[STEP_MM]);
    return turn(REASON_PROGRAM, SIDE_RIGHT, triggered * config->value[TURN_DEG]);
}
