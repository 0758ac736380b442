#include "firmware/memory/memory.h"

enum {
    HALF = CELL_COUNT / 2,
    UPPER_HALF = 16   /* bit 4 of which */
};

static bool is_of_some_kind(const uint8_t cells[CELL_COUNT])
{
    for (unsigned kind = 0; kind < MEMORY_KIND_COUNT; kind++)
        if (memory_is(cells, (enum memory_kind)kind))
            return true;
    return false;
}

bool memory_adopt(struct memory *memory, const uint8_t cells[CELL_COUNT])
{
    if (!is_of_some_kind(cells))
        return false;
    for (unsigned p = 0; p < CELL_COUNT; p++)
        memory->cell[p] = cells[p];
    return true;
}

bool memory_write(struct memory *memory, enum memory_kind kind, uint8_t which, uint32_t bytes)
{
    struct memory wanted = *memory;
    unsigned first = which & UPPER_HALF ? HALF : 0;

    for (unsigned i = 0; i < HALF; i++)
        if (which & (1u << i))
            wanted.cell[first + i] = (uint8_t)(bytes >> 8 * i);
    if (!memory_is(wanted.cell, kind))
        return false;
    *memory = wanted;
    return true;
}
