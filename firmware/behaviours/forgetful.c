/* forgetful: when it is bored, it forgets what it has used since it was blocked, and can be bored again. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/behaviours/listing.h"
#include "firmware/behaviours/used_cells.h"
#include "firmware/pattern.h"

enum { CONFIDENCE = 0, PRAISE = 0 };   /* a cell is a side and no more */

bool forgetful_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action forgetful_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel);
    struct action action;

    used_cells_learn(brain, senses, CONFIDENCE);
    action = listing_next(brain, config, senses, memory_recall(&brain->memory, pattern));
    used_cells_judge(brain, &action, pattern, PRAISE);
    return action;
}
