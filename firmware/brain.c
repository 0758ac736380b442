#include "firmware/brain.h"

#include "firmware/pattern.h"

enum awaits {
    AWAITS_NOTHING,
    AWAITS_LOOK,      /* a step forward was made: look for food */
    AWAITS_VERDICT,   /* a turn was tried: was it any good? */
    AWAITS_BOREDOM    /* one remembered turn too many was made: about face */
};

static struct action turn(enum reason reason, enum side side, unsigned degrees)
{
    int sign = side == SIDE_RIGHT ? 1 : -1;

    return (struct action){.reason = reason, .turn_deg = (int16_t)(sign * (int)degrees)};
}

static struct action step_forward(struct brain *brain, const struct config *config, const struct senses *senses)
{
    brain->repeat_count = 0;
    brain->awaits = AWAITS_LOOK;
    return (struct action){
        .reason = senses->look ? REASON_TOWARD_FOOD : REASON_WANDER,
        .forward_mm = config->value[STEP_MM],
    };
}

static struct action look_around(struct brain *brain, const struct config *config)
{
    enum side side = random_below(&brain->random, 2) ? SIDE_RIGHT : SIDE_LEFT;
    unsigned more = random_below(&brain->random, config->value[LOOK_CHOICES]);

    return turn(REASON_LOOK_AROUND, side, config->value[LOOK_MIN_DEG] + more);
}

static struct action turn_about(struct brain *brain, const struct config *config)
{
    unsigned more = random_below(&brain->random, config->value[BOREDOM_CHOICES]);

    return turn(REASON_BOREDOM, SIDE_RIGHT, config->value[BOREDOM_MIN_DEG] + more);
}

static struct action turn_as_learned(struct brain *brain, const struct config *config, enum side side)
{
    if (brain->repeat_count < UINT8_MAX)
        brain->repeat_count++;
    if (brain->repeat_count == config->value[BOREDOM_LIMIT])
        brain->awaits = AWAITS_BOREDOM;
    return turn(REASON_REMEMBERED, side, config->value[TURN_DEG]);
}

static struct action try_a_turn(struct brain *brain, const struct config *config, uint8_t pattern)
{
    enum side side = random_below(&brain->random, 2) + 1 == SIDE_LEFT ? SIDE_LEFT : SIDE_RIGHT;

    brain->tried_pattern = pattern;
    brain->tried_side = (uint8_t)side;
    brain->awaits = AWAITS_VERDICT;
    return turn(REASON_TRIAL, side, config->value[TRIAL_DEG]);
}

/* Fewer sensors triggered than before the turn: that is all the robot knows of good and bad. */
static void judge_trial(struct brain *brain, const struct senses *senses)
{
    if (brain->frozen || pattern_count(pattern_of(senses->feel)) >= pattern_count(brain->tried_pattern))
        return;
    memory_learn(&brain->memory, brain->tried_pattern, (enum side)brain->tried_side);
    brain->changed = true;
}

/* The top of the listing's loop. */
static struct action decide(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel);
    enum side side = memory_recall(&brain->memory, pattern);

    if (pattern == 0)
        return step_forward(brain, config, senses);
    if (side == SIDE_NOTHING)
        return try_a_turn(brain, config, pattern);
    return turn_as_learned(brain, config, side);
}

void brain_start(struct brain *brain, uint32_t seed)
{
    random_seed(&brain->random, seed);
    brain->repeat_count = 0;
    brain->awaits = AWAITS_NOTHING;
}

struct action brain_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t awaited = brain->awaits;

    brain->awaits = AWAITS_NOTHING;
    if (awaited == AWAITS_BOREDOM)
        return turn_about(brain, config);
    if (awaited == AWAITS_VERDICT)
        judge_trial(brain, senses);
    if (awaited == AWAITS_LOOK && !senses->look)
        return look_around(brain, config);
    if (awaited == AWAITS_LOOK && senses->beacon_mm < config->value[REACH_MM])
        return (struct action){.reason = REASON_EAT};
    return decide(brain, config, senses);
}
