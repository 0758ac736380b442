#include "octet_brain.h"

enum { TRIED = 0, SIDE = 1 };   /* of own: the pattern of a trial, and its side */

bool own_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

static void judge(struct brain *brain, uint8_t pattern)
{
    uint8_t tried = brain->own[TRIED];

    brain->own[TRIED] = 0;
    if (tried == 0 || pattern_count(pattern) >= pattern_count(tried) || brain->frozen)
        return;
    memory_learn(&brain->memory, tried, (enum side)brain->own[SIDE]);
    brain->changed = true;
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel);
    enum side known;

    judge(brain, pattern);
    if (pattern == 0)
        return step(REASON_WANDER, config->value[STEP_MM]);
    known = memory_recall(&brain->memory, pattern);
    if (known != SIDE_NOTHING)
        return turn(REASON_REMEMBERED, known, config->value[TURN_DEG]);
    brain->own[TRIED] = pattern;
    brain->own[SIDE] = (uint8_t)any_side(brain);
    return turn(REASON_TRIAL, (enum side)brain->own[SIDE], config->value[TRIAL_DEG]);
}
