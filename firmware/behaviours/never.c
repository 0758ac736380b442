/* never: it remembers nothing: each time that it is blocked, it tries. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/behaviours/listing.h"

bool never_begin(struct brain *brain)
{
    (void)brain;
    return false;
}

struct action never_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    return listing_next(brain, config, senses, SIDE_NOTHING);
}
