/* never: it remembers nothing, and tries each time that it is blocked. After too many trials in a row the next one is
 * a bigger turn: trials alone reach only eight directions, and a corner can block them all. */
#include "firmware/behaviours/behaviour.h"

bool never_begin(struct brain *brain)
{
    (void)brain;
    return false;
}

struct action never_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    struct action action = listing_next(brain, config, senses, SIDE_NOTHING);
    int sign = action.turn_deg < 0 ? -1 : 1;

    if (action.reason != REASON_TRIAL)
        return action;
    if (brain->repeat_count + 1 < config->value[BOREDOM_LIMIT]) {
        brain->repeat_count++;
        return action;
    }
    brain->repeat_count = 0;
    return (struct action){.reason = REASON_BOREDOM, .turn_deg = (int16_t)(sign * config->value[BOREDOM_MIN_DEG])};
}
