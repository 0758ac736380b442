/* rearmed: the article's robot, but boredom can strike again: the about-face ends the count. */
#include "firmware/behaviours/behaviour.h"

bool rearmed_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action rearmed_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    struct action action = article_next(brain, config, senses);

    if (action.reason == REASON_BOREDOM)
        brain->repeat_count = 0;
    return action;
}
