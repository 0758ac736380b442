#include "firmware/brain.h"

#include "firmware/behaviours/behaviour.h"

#define BEGIN(profile, name) \
    case profile:            \
        return name##_begin(brain);

static bool begin(struct brain *brain)
{
    switch (brain->profile) {
        ROBOT_BEHAVIOURS(BEGIN)
    default:
        return false;
    }
}

bool brain_start(struct brain *brain, uint8_t profile, uint32_t seed)
{
    if (profile >= PROFILE_COUNT)
        return false;
    random_seed(&brain->random, seed);
    brain->profile = profile;
    brain->repeat_count = 0;
    brain->awaits = 0;
    brain->wants_ranges = false;
    brain->learns = begin(brain);
    return true;
}

#define NEXT(profile, name) \
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

void brain_forget_trial(struct brain *brain)
{
    brain->awaits = 0;
}
