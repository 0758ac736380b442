/* comes_up.h: waiting for the hardware where there is no time yet. */
#ifndef OCTET_COMES_UP_H
#define OCTET_COMES_UP_H

#include <stdbool.h>
#include <stdint.h>

enum { COMES_UP_LOOKS = 20000 };   /* some 5 ms at 16 MHz; a crystal starts in 2 ms, a PLL in 0.3 ms */

bool comes_up(volatile const uint32_t *reg, uint32_t mask, uint32_t wanted);
        /* False: these bits of the register have not become what is wanted within so many looks. */

#endif
