/* fixed: the article's "simple coding solution": every front pattern has its programmed turn. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/memory/memory.h"
#include "firmware/pattern.h"

bool fixed_begin(struct brain *brain)
{
    static const uint8_t programmed[CELL_COUNT] = {
        SIDE_NOTHING, SIDE_LEFT, SIDE_LEFT, SIDE_LEFT, SIDE_RIGHT, SIDE_LEFT, SIDE_RIGHT, SIDE_LEFT,
    };

    brain->changed = memory_adopt(&brain->memory, programmed);
    return false;
}

struct action fixed_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    return listing_next(brain, config, senses, memory_recall(&brain->memory, pattern_of(senses->feel)));
}
