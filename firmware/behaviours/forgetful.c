/* forgetful: when it is bored, it forgets what it has used since it was blocked, and can be bored again. Its memory has sides
 * only. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/behaviours/used_cells.h"

bool forgetful_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action forgetful_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    return used_cells_next(brain, config, senses);
}
