#include "firmware/behaviours/behaviour.h"

#include "firmware/memory/memory.h"
#include "firmware/pattern.h"

enum { BLAME = -2 };

static void set_cell(struct brain *brain, uint8_t pattern, uint8_t value)
{
    if (brain->memory.cell[pattern] == value || brain->frozen)
        return;
    brain->memory.cell[pattern] = value;
    brain->changed = true;
}

bool used_cells_learn(struct brain *brain, const struct senses *senses, unsigned confidence)
{
    uint8_t pattern = pattern_of(brain->tried_feel);

    if (!listing_trial_helped(brain, senses) || brain->frozen)
        return false;
    set_cell(brain, pattern, confidence_cell((enum side)brain->tried_side, confidence));
    brain->used |= (uint8_t)(1u << pattern);
    return true;
}

static void change_used(struct brain *brain, uint8_t pattern, int change)
{
    uint8_t *cell = &brain->memory.cell[pattern];
    uint8_t before = *cell;

    set_cell(brain, pattern, confidence_changed(before, change));
    if (before != 0 && *cell == 0)
        brain->unlearned |= (uint8_t)(1u << pattern);
}

static void end_episode(struct brain *brain, int change)
{
    for (uint8_t p = 1; p < CELL_COUNT; p++)
        if (brain->used & (1u << p) && change != 0)
            change_used(brain, p, change);
    brain->used = 0;
}

void used_cells_judge(struct brain *brain, const struct action *action, uint8_t pattern, int praise)
{
    switch (action->reason) {
    case REASON_TRIAL:
        break;
    case REASON_REMEMBERED:
        brain->used |= (uint8_t)(1u << pattern);
        break;
    case REASON_BOREDOM:
        brain->repeat_count = 0;
        end_episode(brain, BLAME);
        break;
    default:   /* the way is clear */
        end_episode(brain, praise);
        break;
    }
}

struct action used_cells_next(struct brain *brain, const struct config *config, const struct senses *senses,
                              unsigned confidence, int praise)
{
    uint8_t pattern = pattern_of(senses->feel);
    struct action action;

    (void)used_cells_learn(brain, senses, confidence);
    action = listing_next(brain, config, senses, memory_recall(&brain->memory, pattern));
    used_cells_judge(brain, &action, pattern, praise);
    return action;
}
