/* comes_up.h: waiting for the hardware at start. */
#ifndef OCTET_COMES_UP_H
#define OCTET_COMES_UP_H

#include <stdbool.h>
#include <stdint.h>

enum {
    CRYSTAL_MS = 100,   /* most start in 2 ms; the maker's own code allows as much */
    SWITCH_MS = 5       /* a PLL locks in 0.3 ms; a switch takes a few cycles */
};

bool comes_up(volatile const uint32_t *reg, uint32_t mask, uint32_t wanted, uint32_t limit_ms);
        /* False: these bits of the register have not become what is wanted within that time. */

#endif
