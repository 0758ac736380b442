/* memory.h: the eight bytes, all that the robot ever learns.
 *
 * Their meaning, or kind, depends on the behaviour (see docs/behaviours.md). In two kinds each pattern has a cell,
 * with the turn to make in its two lowest bits; in the third each reading of all five sensors has two bits. The bytes
 * show their kind, so that one kind is never mistaken for another. An empty memory, all zeros, is of every kind. */
#ifndef OCTET_MEMORY_H
#define OCTET_MEMORY_H

#include "firmware/io.h"

struct memory {
    uint8_t cell[CELL_COUNT];
};

void memory_erase(struct memory *memory);
        /* Empties all cells. */

enum side memory_recall(const struct memory *memory, uint8_t pattern);
        /* The turn learned for pattern 0..7 in a memory with a cell per pattern; SIDE_NOTHING if none. */

void memory_learn(struct memory *memory, uint8_t pattern, enum side side);
        /* Stores side for pattern 1..7, without a confidence. */

#endif
