/* memory.h: the eight bytes, all that the robot ever learns.
 *
 * What they mean is the behaviour's: their kind (see docs/behaviours.md). In two kinds each pattern has a cell, with the
 * turn to make in its two lowest bits; in the third each reading of all five sensors has two bits. The bytes tell their
 * kind, so that a memory is never taken for one of another kind. An empty memory, all zeros, is one of every kind. */
#ifndef OCTET_MEMORY_H
#define OCTET_MEMORY_H

#include "firmware/io.h"

struct memory {
    uint8_t cell[CELL_COUNT];
};

void memory_erase(struct memory *memory);
        /* Empties all cells. */

enum side memory_recall(const struct memory *memory, uint8_t pattern);
        /* The turn learned for pattern 0..7, where each has a cell; SIDE_NOTHING where nothing is. */

void memory_learn(struct memory *memory, uint8_t pattern, enum side side);
        /* Remembers side for pattern 1..7, as a side and nothing else. */

#endif
