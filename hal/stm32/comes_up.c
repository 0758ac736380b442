#include "hal/stm32/comes_up.h"

#include "hal/port/cortex_m/systick.h"

bool comes_up(volatile const uint32_t *reg, uint32_t mask, uint32_t wanted, uint32_t limit_ms)
{
    uint32_t start = machine_ms();

    while ((*reg & mask) != wanted)
        if (machine_ms() - start > limit_ms)
            return false;
    return true;
}
