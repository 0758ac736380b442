/* core_blocks.h: counts the executed instructions, block by block, and drives the clock with them; and the
 * core's own timer (PM0214 4.5), polled. Python reads this header too. */
#ifndef OCTET_CORE_BLOCKS_H
#define OCTET_CORE_BLOCKS_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/emulator/models/board_clock.h"

enum { BLOCKS_KEPT = 4096 };

struct core_block {
    uint64_t address;
    uint32_t size;    /* in bytes; 0: entry not in use */
    uint32_t count;   /* of its instructions */
};

struct core_blocks {
    struct board_clock *clock;   /* one cycle for each instruction */
    uint64_t instructions;       /* executed so far */
    bool stopping;               /* begin no further block */
    uint64_t end;                /* address after the block that was counted last */
    uint64_t counted_to;         /* if a debugger has halted within it: the same address, else 0. The rest of the
                                    block is not counted again, and ends whatever happens */
    int (*stop)(void *emulator);                                                     /* Unicorn's uc_emu_stop */
    int (*read)(void *emulator, uint64_t address, void *bytes, uint64_t size);   /* Unicorn's uc_mem_read */
    struct core_block kept[BLOCKS_KEPT];
};

void core_on_block(void *emulator, uint64_t address, uint32_t size, void *blocks);
        /* Unicorn's hook: a block of instructions is about to be executed. */

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
