#include "octet_brain.h"

enum { NOTHING, STEPPED };                /* awaits: what the last action was */
enum { SINCE = 0, SIDE = 1 };             /* of own: steps since it looked around, the side of its turns */
enum { LOOK_EVERY = 60, BORED = 12 };

bool own_begin(struct brain *brain)
{
    brain->own[SINCE] = LOOK_EVERY;
    return false;
}

static struct action turn_away(struct brain *brain, const struct config *config, uint8_t pattern)
{
    if (brain->repeat_count == 0)
        brain->own[SIDE] = pattern & 1 ? SIDE_LEFT : SIDE_RIGHT;
    if (++brain->repeat_count < BORED)
        return turn(REASON_REMEMBERED, (enum side)brain->own[SIDE], config->value[TURN_DEG]);
    brain->repeat_count = 0;
    return turn(REASON_BOREDOM, SIDE_RIGHT, config->value[BOREDOM_MIN_DEG] + below(brain, config->value[BOREDOM_CHOICES]));
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel), last = brain->awaits;

    brain->awaits = NOTHING;
    if (last == STEPPED && senses->look && senses->beacon_mm < config->value[REACH_MM]) {
        brain->own[SINCE] = LOOK_EVERY;
        return (struct action){.reason = REASON_EAT};
    }
    if (pattern != 0)
        return turn_away(brain, config, pattern);
    brain->repeat_count = 0;
    if (!senses->look && brain->own[SINCE] >= LOOK_EVERY) {
        brain->own[SINCE] = 0;
        return (struct action){.reason = REASON_LOOK_AROUND, .turn_deg = (int16_t)(300 + below(brain, 60)), .until_food = true};
    }
    brain->own[SINCE]++;
    brain->awaits = STEPPED;
    return step(senses->look ? REASON_TOWARD_FOOD : REASON_WANDER, config->value[STEP_MM]);
}
