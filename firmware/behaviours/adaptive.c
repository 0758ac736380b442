/* adaptive: as forgetful, but a cell that has proved its worth is not forgotten at the first failure. */
#include "firmware/behaviours/behaviour.h"

enum { CONFIDENCE = 1, PRAISE = 1 };

bool adaptive_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action adaptive_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    return used_cells_next(brain, config, senses, CONFIDENCE, PRAISE);
}
