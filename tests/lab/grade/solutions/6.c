#include "octet_brain.h"

enum { TRIED = 0, SIDE = 1, BORED = 2 };   /* of own: the pattern of a trial, its side, whether it is bored */

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

static struct action turn_as_known(struct brain *brain, const struct config *config, enum side known)
{
    if (brain->repeat_count < 255)
        brain->repeat_count++;
    brain->own[BORED] = brain->repeat_count == config->value[BOREDOM_LIMIT];
    return turn(REASON_REMEMBERED, known, config->value[TURN_DEG]);
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel), bored = brain->own[BORED];
    enum side known;

    judge(brain, pattern);
    brain->own[BORED] = 0;
    if (bored)
        return turn(REASON_BOREDOM, SIDE_RIGHT, config->value[BOREDOM_MIN_DEG] + below(brain, config->value[BOREDOM_CHOICES]));
    if (pattern == 0) {
        brain->repeat_count = 0;
        return step(REASON_WANDER, config->value[STEP_MM]);
    }
    known = memory_recall(&brain->memory, pattern);
    if (known != SIDE_NOTHING)
        return turn_as_known(brain, config, known);
    brain->own[TRIED] = pattern;
    brain->own[SIDE] = (uint8_t)any_side(brain);
    return turn(REASON_TRIAL, (enum side)brain->own[SIDE], config->value[TRIAL_DEG]);
}
