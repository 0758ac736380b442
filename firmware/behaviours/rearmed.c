/* rearmed: the article's robot, but boredom can strike again: the about-face ends the count. */
#include "firmware/behaviours/behaviour.h"

bool rearmed_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action rearmed_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    if (brain->awaits == AWAITS_BOREDOM)
        brain->repeat_count = 0;
    return article_next(brain, config, senses);
}
