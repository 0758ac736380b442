#include "firmware/sharing.h"

#include "firmware/memory/memory.h"

enum { HALF = CELL_COUNT / 2, SIDE_BITS = 3 };

void sharing_start(struct sharing *sharing)
{
    *sharing = (struct sharing){.whole = false};
}

/* The side in a cell, with confidence or without: it is in the same bits. */
static int vote_of(uint8_t cell)
{
    unsigned side = cell & SIDE_BITS;

    if (cell > SIDE_RIGHT && !confidence_is_cell(cell))
        return 0;
    return (side == SIDE_RIGHT) - (side == SIDE_LEFT);
}

void sharing_hear(struct sharing *sharing, const struct peer *peer)
{
    unsigned first = peer->upper ? HALF : 0;

    for (unsigned i = 0; i < HALF; i++)
        sharing->votes[first + i] = (int8_t)(sharing->votes[first + i] + vote_of(peer->cell[i]));
}

void sharing_begin_second(struct sharing *sharing, const struct config *config)
{
    sharing_start(sharing);
    sharing->whole = config->value[SHARE] != 0;
}
