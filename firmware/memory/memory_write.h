/* memory_write.h: bytes that come from outside, a person or a flash page, become memory only if they are one. */
#ifndef OCTET_MEMORY_WRITE_H
#define OCTET_MEMORY_WRITE_H

#include "firmware/memory/memory.h"

bool memory_adopt(struct memory *memory, const uint8_t cells[CELL_COUNT]);
        /* Takes over all cells. False, and nothing is changed, if they are a memory of no kind. */

bool memory_write(struct memory *memory, enum memory_kind kind, uint8_t which, uint32_t bytes);
        /* Sets the i-th cell of a half, the lower four or with bit 4 of which the upper, to byte i of bytes for each bit i,
           0..3, of which. False, and nothing is changed, if the result is not a memory of that kind. */

#endif
