#include "hal/stm32/comes_up.h"

bool comes_up(volatile const uint32_t *reg, uint32_t mask, uint32_t wanted)
{
    for (unsigned i = 0; i < COMES_UP_LOOKS; i++)
        if ((*reg & mask) == wanted)
            return true;
    return false;
}
