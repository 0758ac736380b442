#include "firmware/memory/memory.h"

enum { SIDE_BITS = 3 };   /* of a cell */

void memory_erase(struct memory *memory)
{
    *memory = (struct memory){{SIDE_NOTHING}};
}

enum side memory_recall(const struct memory *memory, uint8_t pattern)
{
    return (enum side)(memory->cell[pattern] & SIDE_BITS);
}

void memory_learn(struct memory *memory, uint8_t pattern, enum side side)
{
    memory->cell[pattern] = (uint8_t)side;
}
