#include "octet_brain.h"
/* What the last action was, kept in brain->awaits, since own_next begins anew each time. */
enum { NOTHING, STEPPED, TRIED, TURNED, TURNED_ENOUGH };

bool own_begin(struct brain *brain)
{
    (void)brain;   /* nothing to prepare: what is yours is 0, and the memory is what it was */
    return true;   /* this robot learns */
}

/* A trial has ended. If fewer front sensors are triggered now, its side goes into the cell of the old pattern. */
static void judge_trial(struct brain *brain, uint8_t pattern)
{
    uint8_t before = pattern_of(brain->tried_feel);

    if (pattern_count(pattern) >= pattern_count(before) || brain->frozen)
        return;
    memory_learn(&brain->memory, before, (enum side)brain->tried_side);
    brain->changed = true;   /* so that the byte is reported and stored */
}

/* A remembered turn has ended. If it did not help, it is forgotten. */
static void recheck(struct brain *brain, uint8_t pattern)
{
    uint8_t before = pattern_of(brain->tried_feel);

    if (before == 0 || pattern_count(pattern) < pattern_count(before) || brain->frozen)
        return;
    memory_learn(&brain->memory, before, SIDE_NOTHING);
    brain->changed = true;
}

static struct action turn_away(struct brain *brain, const struct config *config, const struct senses *senses)
{
    enum side known = memory_recall(&brain->memory, pattern_of(senses->feel));

    brain->tried_feel = senses->feel;
    if (known == SIDE_NOTHING) {                  /* it knows no turn: it tries one */
        brain->awaits = TRIED;
        brain->tried_side = (uint8_t)any_side(brain);
        return turn(REASON_TRIAL, (enum side)brain->tried_side, config->value[TRIAL_DEG]);
    }
    if (brain->repeat_count < 255)
        brain->repeat_count++;
    brain->awaits = brain->repeat_count == config->value[BOREDOM_LIMIT] ? TURNED_ENOUGH : TURNED;
    return turn(REASON_REMEMBERED, known, config->value[TURN_DEG]);
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    const uint8_t *set = config->value;           /* the parameters: tools/run --set */
    uint8_t pattern = pattern_of(senses->feel), last = brain->awaits;

    brain->awaits = NOTHING;
    if (last == TRIED)
        judge_trial(brain, pattern);
    if (last == TURNED || last == TURNED_ENOUGH)
        recheck(brain, pattern);
    if (last == TURNED_ENOUGH)                    /* it is bored: about face */
        return turn(REASON_BOREDOM, SIDE_RIGHT, set[BOREDOM_MIN_DEG] + below(brain, set[BOREDOM_CHOICES]));
    if (last == STEPPED && !senses->look) {       /* no food ahead: it looks a little to a side */
        enum side side = any_side(brain);
        return turn(REASON_LOOK_AROUND, side, set[LOOK_MIN_DEG] + below(brain, set[LOOK_CHOICES]));
    }
    if (last == STEPPED && senses->beacon_mm < set[REACH_MM])
        return (struct action){.reason = REASON_EAT};
    if (pattern != 0)
        return turn_away(brain, config, senses);
    brain->repeat_count = 0;                      /* the way is clear: a step */
    brain->awaits = STEPPED;
    return step(senses->look ? REASON_TOWARD_FOOD : REASON_WANDER, set[STEP_MM]);
}
