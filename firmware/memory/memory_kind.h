/* memory_kind.h: what the eight bytes of a behaviour mean, and how those of one kind become those of another.
 *
 * The rule: a turn for a pattern stays a turn for that pattern. What only one of the two kinds can hold is lost: how sure
 * the robot was, and what it knew of the side sensors. */
#ifndef OCTET_MEMORY_KIND_H
#define OCTET_MEMORY_KIND_H

#include "firmware/memory/memory.h"

bool memory_is(const uint8_t cells[CELL_COUNT], enum memory_kind kind);
        /* Are these bytes a memory of that kind? */

void memory_put(struct memory *memory, enum memory_kind kind, uint8_t pattern, enum side side);
        /* Sets the turn for pattern 1..7 in a memory of that kind: with the least confidence, and whatever the side
           sensors say. */

bool memory_translate(struct memory *memory, enum memory_kind kind);
        /* Makes it a memory of that kind. False if it was one already; it is unchanged then. */

#endif
