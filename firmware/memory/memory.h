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

/* A cell with a confidence: the side is in bits 0 and 1, the confidence in bits 2 to 7. A cell with a
 * side has confidence 1 to 3; a cell without one is 0. */

bool confidence_is_cell(uint8_t cell);

uint8_t confidence_cell(enum side side, unsigned confidence);
        /* The cell for left or right. */

uint8_t confidence_changed(uint8_t cell, int by);
        /* The cell with its confidence changed, limited to 3. The result is 0, without a side, if no confidence is
           left or the cell had no side. */

/* The eight bytes as a turn for each reading of all five sensors: 32 times two bits, from bit 0 of
 * byte 0 on.
 *
 * The first two readings need no turn, since nothing is in the way. Their four bits, all set, mark the bytes as a
 * memory of this kind: no cell for a pattern has such a value. */

bool feel_memory_is(const uint8_t cells[CELL_COUNT]);
        /* Whether these bytes are such a memory: all zeros, or marked and with valid sides for all other readings. */

enum side feel_memory_recall(const struct memory *memory, uint8_t feel);
        /* The turn learned for a reading with something in the way; SIDE_NOTHING where nothing is. */

void feel_memory_learn(struct memory *memory, uint8_t feel, enum side side);
        /* Stores side for a reading with something in the way. */

/* The kinds of memory, and conversion between them.
 *
 * A turn for a pattern stays a turn for that pattern. What only one of the two kinds can hold is lost: confidence,
 * and differences by side sensor. */

bool memory_is(const uint8_t cells[CELL_COUNT], enum memory_kind kind);
        /* Whether these bytes are a memory of that kind. */

void memory_put(struct memory *memory, enum memory_kind kind, uint8_t pattern, enum side side);
        /* Sets the turn for pattern 1..7 in a memory of that kind: with the lowest confidence, and for all readings
           of the side sensors. */

bool memory_translate(struct memory *memory, enum memory_kind kind);
        /* Converts to that kind. False if it was of that kind already; it is unchanged then. */

/* Writes bytes from outside (a person or a flash page) to the memory, if they are a valid memory. */

bool memory_adopt(struct memory *memory, const uint8_t cells[CELL_COUNT]);
        /* Sets all cells. False if they are no memory of any kind; nothing is changed then. */

bool memory_write(struct memory *memory, enum memory_kind kind, uint8_t which, uint32_t bytes);
        /* For each bit i, 0..3, of which: sets the i-th cell of a half to byte i of bytes. Bit 4 of which selects the
           upper half, else the lower. False if the result is not a memory of that kind; nothing is changed then. */

#endif
