/* forgetful: when it is bored, it forgets what it has used since it was blocked, and can be bored again. */
#include "firmware/behaviours/behaviour.h"

enum { CONFIDENCE = 0, PRAISE = 0 };   /* a cell is a side and no more */

bool forgetful_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action forgetful_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    return used_cells_next(brain, config, senses, CONFIDENCE, PRAISE);
}
