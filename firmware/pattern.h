/* pattern.h: the reading of the three front sensors, and how many of them are triggered. */
#ifndef OCTET_PATTERN_H
#define OCTET_PATTERN_H

#include <stdint.h>

uint8_t pattern_of(uint8_t feel);
        /* The three front sensors of the five, 0..7: bit 0 front-right, bit 1 front, bit 2 front-left.
           0: the way is clear. */

uint8_t pattern_count(uint8_t pattern);
        /* How many of the three are triggered, 0..3. */

#endif
