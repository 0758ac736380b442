#include "firmware/memory.h"

static bool is_valid(const uint8_t cells[CELL_COUNT])
{
    static const uint8_t max[CELL_COUNT] = ROBOT_CELL_MAX;

    for (unsigned p = 0; p < CELL_COUNT; p++)
        if (cells[p] > max[p])
            return false;
    return true;
}

void memory_erase(struct memory *memory)
{
    *memory = (struct memory){{SIDE_NOTHING}};
}

enum side memory_recall(const struct memory *memory, uint8_t pattern)
{
    return (enum side)memory->cell[pattern];
}

void memory_learn(struct memory *memory, uint8_t pattern, enum side side)
{
    memory->cell[pattern] = (uint8_t)side;
}

bool memory_adopt(struct memory *memory, const uint8_t cells[CELL_COUNT])
{
    if (!is_valid(cells))
        return false;
    for (unsigned p = 0; p < CELL_COUNT; p++)
        memory->cell[p] = cells[p];
    return true;
}

bool memory_write(struct memory *memory, unsigned half, uint8_t mask, uint32_t bytes)
{
    struct memory wanted = *memory;

    for (unsigned i = 0; i < CELL_COUNT / 2; i++)
        if (mask & (1u << i))
            wanted.cell[CELL_COUNT / 2 * half + i] = (uint8_t)(bytes >> 8 * i);
    return memory_adopt(memory, wanted.cell);
}
