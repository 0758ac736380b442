/* adaptive: as forgetful, but its memory has confidences, as robot.toml says: a cell that has proved its worth is not forgotten
 * at once. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/behaviours/used_cells.h"

bool adaptive_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

struct action adaptive_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    return used_cells_next(brain, config, senses);
}
