/* memory.h: the eight bytes, all that the robot ever learns. One cell for each pattern holds the turn to make. */
#ifndef OCTET_MEMORY_H
#define OCTET_MEMORY_H

#include "firmware/io.h"

struct memory {
    uint8_t cell[CELL_COUNT];   /* an enum side for each pattern; cell 0, nothing in the way, stays empty */
};

void memory_erase(struct memory *memory);

enum side memory_recall(const struct memory *memory, uint8_t pattern);
        /* The turn learned for pattern 0..7; SIDE_NOTHING where nothing is. */

void memory_learn(struct memory *memory, uint8_t pattern, enum side side);
        /* Remembers side for pattern 1..7. */

bool memory_adopt(struct memory *memory, const uint8_t cells[CELL_COUNT]);
        /* Takes over all cells. False, and nothing is changed, if they are no memory. */

bool memory_write(struct memory *memory, unsigned half, uint8_t mask, uint32_t bytes);
        /* Sets the i-th cell of a half, 0 for the lower four and 1 for the upper, to byte i of bytes for each bit i, 0..3,
           of mask. False, and nothing is changed, if they are no memory then. */

#endif
