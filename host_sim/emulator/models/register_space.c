#include "host_sim/emulator/models/register_space.h"

enum { WORD = 4, NOT_CAN = SPACE_CAN_WORDS };

void space_begin_anew(struct register_space *space)
{
    space->old_news = 0;
    space->looks_at_time = false;
}

void space_note(struct register_space *space, bool is_news)
{
    if (is_news) {
        space_begin_anew(space);
        return;
    }
    space->old_news++;
    if (space->old_news > SPACE_WAITING_READS && space->looks_at_time) {
        space_begin_anew(space);
        clock_skip_to_event(space->clock, SPACE_SKIP_NS);
    }
}

void space_note_time(struct register_space *space)
{
    space->looks_at_time = true;
}

uint32_t space_can_word(uint32_t offset)
{
    uint32_t half = offset >= SPACE_CAN_RAM ? SPACE_CAN_WORDS / 2 : 0;
    uint32_t word = (half ? offset - SPACE_CAN_RAM : offset) / WORD;

    return offset % WORD == 0 && word < SPACE_CAN_WORDS / 2 ? half + word : NOT_CAN;
}

/* The number of a register of CAN that can be accessed here, or NOT_CAN. */
static uint32_t can_word(const struct register_space *space, uint32_t address, unsigned width)
{
    return space->direct && width == WORD && space->can->clocked
         ? space_can_word(address - space->can_base) : NOT_CAN;
}

static bool read_can(struct register_space *space, uint32_t address, uint32_t word, uint32_t *out)
{
    int64_t value = node_read(space->can, address - space->can_base);
    struct seen_value *seen = &space->seen[word];
    bool is_news;

    if (value < 0)
        return false;
    *out = (uint32_t)value;
    is_news = !seen->known || seen->value != *out;
    *seen = (struct seen_value){ true, *out };
    space_note(space, is_news);
    return true;
}

/* The block and the word of a register that is kept here, or NULL. */
static struct plain_block *find(const struct register_space *space, uint32_t address, unsigned width, uint32_t *word)
{
    for (unsigned i = 0; i < space->block_count && width == WORD && address % WORD == 0; i++) {
        struct plain_block *block = space->blocks[i];

        *word = (address - block->base) / WORD;
        if (address >= block->base && *word < SPACE_BLOCK_WORDS)
            return block->clocked ? block : NULL;
    }
    return NULL;
}

static bool read_kept(struct register_space *space, uint32_t address, unsigned width, uint32_t *out)
{
    uint32_t word;
    const struct plain_block *block = find(space, address, width, &word);

    if (!block || !(block->readable >> word & 1u))
        return false;
    *out = block->value[word];
    space_begin_anew(space);
    return true;
}

static void set_pins(struct plain_block *block, uint32_t bsrr, uint32_t value)
{
    uint32_t *idr = &block->value[bsrr - 2], *odr = &block->value[bsrr - 1];

    *odr = (*odr & ~(value >> 16)) | (value & 0xFFFFu);
    *idr = (*idr & ~block->outputs) | (*odr & block->outputs);
}

static bool write_kept(struct register_space *space, uint32_t address, unsigned width, uint32_t value)
{
    uint32_t word;
    struct plain_block *block = find(space, address, width, &word);

    if (!block || !(block->writable >> word & 1u))
        return false;
    space_begin_anew(space);
    if (block->write[word] == SPACE_SETS_PINS)
        set_pins(block, word, value);
    else
        block->value[word] = block->write[word] == SPACE_KEPT ? value : block->value[word] & value;
    return true;
}

static bool read_here(struct register_space *space, uint32_t address, unsigned width, uint32_t *out)
{
    uint32_t word = can_word(space, address, width);

    if (word != NOT_CAN && space->can_readable[word])
        return read_can(space, address, word, out);
    if (!space->direct)
        return false;
    if (read_kept(space, address, width, out))
        return true;
    if (address != space->systick_val || width != WORD)
        return false;
    *out = systick_value(space->systick);
    space_note_time(space);
    return true;
}

static bool write_here(struct register_space *space, uint32_t address, unsigned width, uint32_t value)
{
    uint32_t word = can_word(space, address, width);

    if (space->direct && write_kept(space, address, width, value))
        return true;
    if (word == NOT_CAN || !space->can_writable[word])
        return false;
    space_begin_anew(space);
    space->can->wire->now_ns = space->clock->now.ns;
    if (!node_write(space->can, address - space->can_base, value))
        return false;
    clock_expect(space->clock, space->clock->now);
    return true;
}

uint64_t window_read(void *emulator, uint64_t offset, unsigned width, void *context)
{
    const struct register_window *window = context;
    uint32_t address = window->base + (uint32_t)offset;
    uint32_t value;

    (void)emulator;
    if (window->clock->failed)
        return 0;
    if (window->space && read_here(window->space, address, width, &value))
        return value;
    return window->read(address, width);
}

void window_write(void *emulator, uint64_t offset, unsigned width, uint64_t value, void *context)
{
    const struct register_window *window = context;
    uint32_t address = window->base + (uint32_t)offset;

    (void)emulator;
    if (window->clock->failed)
        return;
    if (!window->space || !write_here(window->space, address, width, (uint32_t)value))
        window->write(address, width, (uint32_t)value);
}
