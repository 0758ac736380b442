/* systick_model.h: the core's own timer (PM0214 4.5), polled. Python reads this header too. */
#ifndef OCTET_SYSTICK_MODEL_H
#define OCTET_SYSTICK_MODEL_H

#include <stdint.h>

#include "host_sim/emulator/models/board_clock.h"

enum { SYSTICK_ENABLE = 1 << 0, SYSTICK_CLKSOURCE = 1 << 2, SYSTICK_DIVISOR = 8 };

struct systick {
    const struct board_clock *clock;
    uint32_t ctrl;
    uint32_t load;
    uint64_t since_cycles;   /* when it was restarted */
};

uint64_t systick_counted(const struct systick *timer);
        /* Counts since it was restarted. */

uint32_t systick_value(const struct systick *timer);
        /* VAL: counts down from LOAD to 0, over and over. */

#endif
