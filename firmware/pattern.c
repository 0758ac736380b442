#include "firmware/pattern.h"

uint8_t pattern_of(uint8_t feel)
{
    return (uint8_t)((feel >> 1) & 7u);   /* the side sensors see nothing that is in the way */
}

uint8_t pattern_count(uint8_t pattern)
{
    return (uint8_t)((pattern & 1u) + ((pattern >> 1) & 1u) + ((pattern >> 2) & 1u));
}
