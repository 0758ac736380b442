/* confidence.h: a cell that says how sure the robot is of its turn: the side in bits 0 and 1, the confidence in bits 2
 * to 7. A cell with a side has confidence 1 to 3; a cell without one is 0. */
#ifndef OCTET_CONFIDENCE_H
#define OCTET_CONFIDENCE_H

#include "firmware/io.h"

bool confidence_is_cell(uint8_t cell);

uint8_t confidence_cell(enum side side, unsigned confidence);
        /* The cell for left or right. */

uint8_t confidence_changed(uint8_t cell, int by);
        /* The cell with more or less confidence: never more than 3; 0, without a side, when none is left or
           there was none. */

#endif
