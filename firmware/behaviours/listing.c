#include "firmware/behaviours/behaviour.h"

#include "firmware/pattern.h"

enum { FILTER_TICKS = 2 };   /* after these, all filtered readings are from the same place */

static struct action turn(enum reason reason, enum side side, unsigned degrees)
{
    int sign = side == SIDE_RIGHT ? 1 : -1;

    return (struct action){.reason = reason, .turn_deg = (int16_t)(sign * (int)degrees)};
}

struct action listing_step(struct brain *brain, const struct config *config, const struct senses *senses)
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
    enum side side = (enum side)(SIDE_LEFT + random_below(&brain->random, 2));
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
    brain->tried_side = (uint8_t)side;
    brain->awaits = brain->repeat_count == config->value[BOREDOM_LIMIT] ? AWAITS_BOREDOM : AWAITS_CHECK;
    return turn(REASON_REMEMBERED, side, config->value[TURN_DEG]);
}

static struct action try_a_turn(struct brain *brain, const struct config *config)
{
    enum side side = (enum side)(SIDE_LEFT + random_below(&brain->random, 2));
    struct action trial = turn(REASON_TRIAL, side, config->value[TRIAL_DEG]);

    brain->tried_side = (uint8_t)side;
    brain->awaits = AWAITS_VERDICT;
    trial.rest_ticks = config->value[FILTER] ? FILTER_TICKS : 0;
    return trial;
}

/* The top of the listing's loop. */
static struct action decide(struct brain *brain, const struct config *config, const struct senses *senses,
                            enum side known)
{
    if (pattern_of(senses->feel) == 0)
        return listing_step(brain, config, senses);
    brain->tried_feel = senses->feel;
    if (known == SIDE_NOTHING)
        return try_a_turn(brain, config);
    return turn_as_learned(brain, config, known);
}

/* Fewer sensors triggered than before the turn: that is all the robot knows of good and bad. */
static bool turn_helped(const struct brain *brain, const struct senses *senses)
{
    return pattern_count(pattern_of(senses->feel)) < pattern_count(pattern_of(brain->tried_feel));
}

bool listing_trial_helped(const struct brain *brain, const struct senses *senses)
{
    return brain->awaits == AWAITS_VERDICT && turn_helped(brain, senses);
}

bool listing_remembered_in_vain(const struct brain *brain, const struct senses *senses)
{
    return brain->awaits >= AWAITS_BOREDOM   /* or AWAITS_CHECK */
        && brain->tried_feel != TEACHES_NOTHING && !turn_helped(brain, senses);
}

struct action listing_next(struct brain *brain, const struct config *config, const struct senses *senses,
                           enum side known)
{
    uint8_t awaited = brain->awaits;

    brain->awaits = AWAITS_NOTHING;
    if (awaited == AWAITS_BOREDOM)
        return turn_about(brain, config);
    if (awaited == AWAITS_LOOK && !senses->look)
        return look_around(brain, config);
    if (awaited == AWAITS_LOOK && senses->beacon_mm < config->value[REACH_MM])
        return (struct action){.reason = REASON_EAT};
    return decide(brain, config, senses, known);
}
