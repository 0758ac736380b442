#include "firmware/brain.h"

#include "firmware/behaviours/behaviour.h"
#include "firmware/memory/memory.h"

#define KIND(profile, name, kind) [profile] = kind,

const uint8_t BRAIN_MEMORY_KINDS[PROFILE_OWN + 1] = {ROBOT_BEHAVIOURS(KIND)};

#define BEGIN(profile, name, kind) \
    case profile:            \
        return name##_begin(brain);

static bool begin(struct brain *brain)
{
    brain->wants_ranges = false;
    switch (brain->profile) {
        ROBOT_BEHAVIOURS(BEGIN)
    default:
        return false;
    }
}

bool brain_start(struct brain *brain, uint8_t profile, uint32_t seed)
{
    if (profile >= PROFILE_COUNT && (profile != PROFILE_OWN || !OWN_IS_LINKED))
        return false;
    random_seed(&brain->random, seed);
    brain->profile = profile;
    brain->repeat_count = 0;
    brain->awaits = 0;
    brain->used = 0;
    brain->unlearned = 0;
    for (uint8_t i = 0; i < sizeof brain->own; i++)
        brain->own[i] = 0;
    brain->changed = memory_translate(&brain->memory, (enum memory_kind)BRAIN_MEMORY_KINDS[profile])
                   || brain->changed;
    brain->learns = begin(brain);
    return true;
}

static bool understands(uint8_t profile, const struct memory *memory)
{
    return memory_is(memory->cell, (enum memory_kind)BRAIN_MEMORY_KINDS[profile]);
}

bool brain_adopt(struct brain *brain, const uint8_t cells[CELL_COUNT])
{
    uint8_t profile = PROFILE_COUNT;

    if (!memory_adopt(&brain->memory, cells))
        return false;
    if (understands(brain->profile, &brain->memory))
        return true;
    while (profile > 0) {   /* backward, so that the first one is set last */
        profile--;
        if (understands(profile, &brain->memory))
            brain->profile = profile;
    }
    brain->learns = begin(brain);
    return true;
}

bool brain_write(struct brain *brain, uint8_t which, uint32_t bytes)
{
    if (!memory_write(&brain->memory, (enum memory_kind)BRAIN_MEMORY_KINDS[brain->profile], which, bytes))
        return false;
    brain->changed = true;
    return true;
}

#define NEXT(profile, name, kind) \
    case profile:           \
        return name##_next(brain, config, senses);

struct action brain_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    switch (brain->profile) {
        ROBOT_BEHAVIOURS(NEXT)
    default:
        return (struct action){.reason = REASON_STOP};
    }
}

static bool may_take(const struct brain *brain, uint8_t pattern)
{
    return memory_recall(&brain->memory, pattern) == SIDE_NOTHING && !(brain->unlearned & (1u << pattern));
}

bool brain_take_votes(struct brain *brain, const int8_t votes[CELL_COUNT])
{
    enum memory_kind kind = (enum memory_kind)BRAIN_MEMORY_KINDS[brain->profile];
    bool took = false;

    if (!brain->learns || brain->frozen || kind == MEMORY_KIND_ALL_SENSORS)
        return false;
    for (uint8_t p = 1; p < CELL_COUNT; p++)
        if (votes[p] != 0 && may_take(brain, p)) {
            memory_put(&brain->memory, kind, p, votes[p] > 0 ? SIDE_RIGHT : SIDE_LEFT);
            took = true;
        }
    return took;
}

void brain_doubt(struct brain *brain, const struct senses *senses)
{
    brain->tried_feel = TEACHES_NOTHING;
    brain->used = 0;
    if (brain->awaits == AWAITS_LOOK && !senses->look)
        brain->awaits = AWAITS_NOTHING;
}
