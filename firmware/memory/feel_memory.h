/* feel_memory.h: the eight bytes as a turn for each reading of all five sensors: 32 times two bits, from bit 0 of
 * byte 0 on.
 *
 * The first two readings need no turn, since nothing is in the way. Their four bits, all set, mark the bytes as a
 * memory of this kind: no cell for a pattern has such a value. */
#ifndef OCTET_FEEL_MEMORY_H
#define OCTET_FEEL_MEMORY_H

#include "firmware/memory/memory.h"

bool feel_memory_is(const uint8_t cells[CELL_COUNT]);
        /* Whether these bytes are such a memory: all zeros, or marked and with valid sides for all other readings. */

enum side feel_memory_recall(const struct memory *memory, uint8_t feel);
        /* The turn learned for a reading with something in the way; SIDE_NOTHING where nothing is. */

void feel_memory_learn(struct memory *memory, uint8_t feel, enum side side);
        /* Stores side for a reading with something in the way. */

#endif
