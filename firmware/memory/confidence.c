#include "firmware/memory/memory.h"

enum { CONFIDENCE_MAX = 3, SIDE_BITS = 2 };

static enum side side_of(uint8_t cell)
{
    return (enum side)(cell & ((1u << SIDE_BITS) - 1));
}

bool confidence_is_cell(uint8_t cell)
{
    unsigned confidence = (unsigned)cell >> SIDE_BITS;

    if (cell == 0)
        return true;
    return (side_of(cell) == SIDE_LEFT || side_of(cell) == SIDE_RIGHT) && confidence >= 1
        && confidence <= CONFIDENCE_MAX;
}

uint8_t confidence_cell(enum side side, unsigned confidence)
{
    return (uint8_t)(confidence << SIDE_BITS | (unsigned)side);
}

uint8_t confidence_changed(uint8_t cell, int by)
{
    int confidence = (cell >> SIDE_BITS) + by;

    if (side_of(cell) == SIDE_NOTHING || confidence <= 0)
        return 0;
    return confidence_cell(side_of(cell), confidence > CONFIDENCE_MAX ? CONFIDENCE_MAX : (unsigned)confidence);
}
