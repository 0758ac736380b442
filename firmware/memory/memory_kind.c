#include "firmware/memory/memory.h"

enum { BESIDE_COUNT = 4 };   /* combinations of the side sensors' bits */

static uint8_t reading(uint8_t pattern, unsigned i)
{
    return (uint8_t)(2u * pattern | (i & 1u) * FEEL_RIGHT | (i >> 1) * FEEL_LEFT);
}

static bool has_a_cell_each(const uint8_t cells[CELL_COUNT], enum memory_kind kind)
{
    for (unsigned p = 1; p < CELL_COUNT; p++)
        if (kind == MEMORY_KIND_CONFIDENCE ? !confidence_is_cell(cells[p]) : cells[p] > SIDE_RIGHT)
            return false;
    return cells[0] == SIDE_NOTHING;
}

bool memory_is(const uint8_t cells[CELL_COUNT], enum memory_kind kind)
{
    return kind == MEMORY_KIND_ALL_SENSORS ? feel_memory_is(cells) : has_a_cell_each(cells, kind);
}

void memory_put(struct memory *memory, enum memory_kind kind, uint8_t pattern, enum side side)
{
    if (kind == MEMORY_KIND_SIDES)
        memory_learn(memory, pattern, side);
    else if (kind == MEMORY_KIND_CONFIDENCE)
        memory->cell[pattern] = side == SIDE_NOTHING ? 0 : confidence_cell(side, 1);
    else
        for (unsigned i = 0; i < BESIDE_COUNT; i++)
            feel_memory_learn(memory, reading(pattern, i), side);
}

/* The more frequent turn among the readings with that pattern; none if there is a tie. */
static enum side side_of_most(const struct memory *memory, uint8_t pattern)
{
    int right = 0;   /* readings that turn right, less those that turn left */

    for (unsigned i = 0; i < BESIDE_COUNT; i++) {
        enum side side = feel_memory_recall(memory, reading(pattern, i));

        if (side == SIDE_RIGHT)
            right++;
        if (side == SIDE_LEFT)
            right--;
    }
    if (right > 0)
        return SIDE_RIGHT;
    return right < 0 ? SIDE_LEFT : SIDE_NOTHING;
}

bool memory_translate(struct memory *memory, enum memory_kind kind)
{
    const struct memory before = *memory;
    bool of_all_sensors = feel_memory_is(before.cell);

    if (memory_is(before.cell, kind))
        return false;
    memory_erase(memory);
    for (uint8_t p = 1; p < CELL_COUNT; p++)
        memory_put(memory, kind, p, of_all_sensors ? side_of_most(&before, p) : memory_recall(&before, p));
    return true;
}
