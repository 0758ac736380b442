#include "host_sim/emulator/models/systick_model.h"

uint64_t systick_counted(const struct systick *timer)
{
    if (!(timer->ctrl & SYSTICK_ENABLE))
        return 0;
    return (timer->clock->cycles - timer->since_cycles) / (timer->ctrl & SYSTICK_CLKSOURCE ? 1 : SYSTICK_DIVISOR);
}

uint32_t systick_value(const struct systick *timer)
{
    uint64_t past = systick_counted(timer) % ((uint64_t)timer->load + 1);

    return past == 0 ? 0 : (uint32_t)(timer->load + 1 - past);
}
