/* memory_write.h: writes bytes from outside (a person or a flash page) to the memory, if they are a valid memory. */
#ifndef OCTET_MEMORY_WRITE_H
#define OCTET_MEMORY_WRITE_H

#include "firmware/memory/memory.h"

bool memory_adopt(struct memory *memory, const uint8_t cells[CELL_COUNT]);
        /* Sets all cells. False if they are no memory of any kind; nothing is changed then. */

bool memory_write(struct memory *memory, enum memory_kind kind, uint8_t which, uint32_t bytes);
        /* For each bit i, 0..3, of which: sets the i-th cell of a half to byte i of bytes. Bit 4 of which selects the
           upper half, else the lower. False if the result is not a memory of that kind; nothing is changed then. */

#endif
