#include "host_sim/emulator/models/core_blocks.h"

enum { WIDE_FROM = 0xE800 };   /* half-words from here on begin an instruction of two */

static uint32_t count(const struct core_blocks *blocks, void *emulator, uint64_t address, uint32_t size)
{
    uint32_t instructions = 0;
    uint8_t code[2];

    for (uint32_t at = 0; at < size; instructions++) {
        if (blocks->read(emulator, address + at, code, sizeof code) != 0)
            break;
        at += (code[0] | code[1] << 8) >= WIDE_FROM ? 4 : 2;
    }
    return instructions;
}

static const struct core_block *look_up(struct core_blocks *blocks, void *emulator, uint64_t address, uint32_t size)
{
    struct core_block *block = &blocks->kept[address / 2 % BLOCKS_KEPT];

    if (block->address != address || block->size != size)
        *block = (struct core_block){ address, size, count(blocks, emulator, address, size) };
    return block;
}

void core_on_block(void *emulator, uint64_t address, uint32_t size, void *context)
{
    struct core_blocks *blocks = context;
    uint32_t instructions;

    if (blocks->counted_to != 0) {
        blocks->counted_to = address + size < blocks->counted_to ? blocks->counted_to : 0;
        return;
    }
    if (blocks->stopping || blocks->clock->failed) {
        (void)blocks->stop(emulator);
        return;
    }
    instructions = look_up(blocks, emulator, address, size)->count;
    blocks->instructions += instructions;
    blocks->end = address + size;
    clock_execute(blocks->clock, instructions);
}

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
