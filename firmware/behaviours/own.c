/* own: not there. Its user's behaviour is linked in the place of this file; see docs/own-brain.md. */
#include "firmware/behaviours/behaviour.h"

const bool OWN_IS_LINKED = false;

bool own_begin(struct brain *brain)
{
    (void)brain;
    return false;
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    (void)brain;
    (void)config;
    (void)senses;
    return (struct action){.reason = REASON_STOP};
}
