/* confidence.h: a cell with a confidence: the side is in bits 0 and 1, the confidence in bits 2 to 7. A cell with a
 * side has confidence 1 to 3; a cell without one is 0. */
#ifndef OCTET_CONFIDENCE_H
#define OCTET_CONFIDENCE_H

#include "firmware/io.h"

bool confidence_is_cell(uint8_t cell);

uint8_t confidence_cell(enum side side, unsigned confidence);
        /* The cell for left or right. */

uint8_t confidence_changed(uint8_t cell, int by);
        /* The cell with its confidence changed, limited to 3. The result is 0, without a side, if no confidence is
           left or the cell had no side. */

#endif
