/* recheck: the article's challenge: each remembered turn is checked, and forgotten if it did not help. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/pattern.h"

bool recheck_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action recheck_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    if (listing_remembered_in_vain(brain, senses) && !brain->frozen) {
        memory_learn(&brain->memory, pattern_of(brain->tried_feel), SIDE_NOTHING);
        brain->changed = true;
    }
    return article_next(brain, config, senses);
}
