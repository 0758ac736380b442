/* five: the article's robot with a turn for each reading of all five sensors. The front three still decide what is in
 * the way and judge a trial. Boredom can strike again, as in rearmed, forgetting turns for what was in the way. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/memory/memory.h"
#include "firmware/pattern.h"

bool five_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

/* The obstacle ahead was the same whatever was beside it. */
static void forget(struct brain *brain)
{
    brain->repeat_count = 0;
    if (brain->frozen || brain->tried_feel == TEACHES_NOTHING)
        return;
    memory_put(&brain->memory, MEMORY_KIND_ALL_SENSORS, pattern_of(brain->tried_feel), SIDE_NOTHING);
    brain->changed = true;
}

struct action five_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    struct action action;

    if (listing_trial_helped(brain, senses) && !brain->frozen) {
        feel_memory_learn(&brain->memory, brain->tried_feel, (enum side)brain->tried_side);
        brain->changed = true;
    }
    action = listing_next(brain, config, senses, feel_memory_recall(&brain->memory, senses->feel));
    if (action.reason == REASON_BOREDOM)
        forget(brain);
    return action;
}
