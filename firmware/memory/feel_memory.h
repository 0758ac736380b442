/* feel_memory.h: the eight bytes as a turn for each reading of all five sensors: 32 times two bits, from bit 0 of byte 0
 * on.
 *
 * The first two readings are never of use, since nothing is in the way then. Their four bits, all set, mark the bytes
 * as such a memory: no cell for a pattern has such a byte. */
#ifndef OCTET_FEEL_MEMORY_H
#define OCTET_FEEL_MEMORY_H

#include "firmware/memory/memory.h"

bool feel_memory_is(const uint8_t cells[CELL_COUNT]);
        /* Are these bytes such a memory: all zeros, or marked, and sides wherever something is in the way? */

enum side feel_memory_recall(const struct memory *memory, uint8_t feel);
        /* The turn learned for a reading with something in the way; SIDE_NOTHING where nothing is. */

void feel_memory_learn(struct memory *memory, uint8_t feel, enum side side);
        /* Remembers side for such a reading. */

#endif
