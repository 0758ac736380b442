#include "firmware/memory/memory.h"

#include "firmware/pattern.h"

enum {
    READINGS = 32,
    PER_BYTE = 4,
    MARK_BYTE = 0,
    MARK = 0x0F,
    BITS = 3   /* of one reading */
};

static unsigned shift_of(uint8_t feel)
{
    return 2u * (feel % PER_BYTE);
}

static unsigned bits_for(const uint8_t cells[CELL_COUNT], uint8_t feel)
{
    return ((unsigned)cells[feel / PER_BYTE] >> shift_of(feel)) & BITS;
}

static bool is_empty(const uint8_t cells[CELL_COUNT])
{
    uint8_t any = 0;

    for (unsigned i = 0; i < CELL_COUNT; i++)
        any |= cells[i];
    return any == 0;
}

bool feel_memory_is(const uint8_t cells[CELL_COUNT])
{
    if (is_empty(cells))
        return true;
    for (uint8_t feel = PER_BYTE / 2; feel < READINGS; feel++)
        if (bits_for(cells, feel) > (pattern_of(feel) == 0 ? SIDE_NOTHING : SIDE_RIGHT))
            return false;
    return (cells[MARK_BYTE] & MARK) == MARK;
}

enum side feel_memory_recall(const struct memory *memory, uint8_t feel)
{
    return (enum side)bits_for(memory->cell, feel);
}

void feel_memory_learn(struct memory *memory, uint8_t feel, enum side side)
{
    uint8_t *byte = &memory->cell[feel / PER_BYTE];

    *byte = (uint8_t)((*byte & ~((unsigned)BITS << shift_of(feel))) | (unsigned)side << shift_of(feel));
    memory->cell[MARK_BYTE] |= MARK;
}
