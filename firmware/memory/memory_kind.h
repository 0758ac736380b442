/* memory_kind.h: the kinds of memory, and conversion between them.
 *
 * A turn for a pattern stays a turn for that pattern. What only one of the two kinds can hold is lost: confidence,
 * and differences by side sensor. */
#ifndef OCTET_MEMORY_KIND_H
#define OCTET_MEMORY_KIND_H

#include "firmware/memory/memory.h"

bool memory_is(const uint8_t cells[CELL_COUNT], enum memory_kind kind);
        /* Whether these bytes are a memory of that kind. */

void memory_put(struct memory *memory, enum memory_kind kind, uint8_t pattern, enum side side);
        /* Sets the turn for pattern 1..7 in a memory of that kind: with the lowest confidence, and for all readings
           of the side sensors. */

bool memory_translate(struct memory *memory, enum memory_kind kind);
        /* Converts to that kind. False if it was of that kind already; it is unchanged then. */

#endif
