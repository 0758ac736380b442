/* pattern.h: what the three front sensors say together, and how bad that is. */
#ifndef OCTET_PATTERN_H
#define OCTET_PATTERN_H

#include <stdint.h>

uint8_t pattern_of(uint8_t feel);
        /* The three front sensors of the five, 0..7: bit 0 front-right, bit 1 front, bit 2 front-left.
           0: the way is clear. */

uint8_t pattern_count(uint8_t pattern);
        /* How many of the three are triggered, 0..3. */

#endif
