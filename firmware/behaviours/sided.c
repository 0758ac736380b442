/* sided: the article's robot, but it takes no lesson from an obstacle that has no side: patterns 2, 5 and 7.
 * What helped there was luck, and the next time the other side is as good. */
#include "firmware/behaviours/behaviour.h"

bool sided_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action sided_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    unsigned feel = brain->tried_feel;

    if (((feel ^ feel >> 2u) & FEEL_FRONT_RIGHT) == 0u)   /* front-left is two bits from front-right */
        brain->tried_feel = TEACHES_NOTHING;
    return article_next(brain, config, senses);
}
