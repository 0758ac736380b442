/* article: a trial that helped is remembered, and what is remembered is done again. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/pattern.h"

bool article_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action article_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    if (listing_trial_helped(brain, senses) && !brain->frozen) {
        memory_learn(&brain->memory, pattern_of(brain->tried_feel), (enum side)brain->tried_side);
        brain->changed = true;
    }
    return listing_next(brain, config, senses, memory_recall(&brain->memory, pattern_of(senses->feel)));
}
