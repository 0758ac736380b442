/* searcher: as adaptive, with another way of looking for food: it drives straight on, turns once around where it has not
 * looked for a while, and goes straight to what it sees. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/behaviours/listing.h"
#include "firmware/behaviours/used_cells.h"
#include "firmware/pattern.h"

enum {
    CONFIDENCE = 1,
    PRAISE = 1,
    LOOK_EVERY_MM = 1000,   /* way between two turns around */
    LOOK_AGAIN_MM = 200,    /* after losing sight of food: way to the next one */
    MISSES_MAX = 2,         /* the way to the next look doubles at most this many times */
    WHOLE_TURN_DEG = 360,
    LEAVE_CHOICES = 180     /* of the direction in which it goes on where it has seen no food, one degree apart */
};

bool searcher_begin(struct brain *brain)
{
    brain->since_mm = LOOK_EVERY_MM;
    brain->chasing = false;
    brain->ate = false;
    brain->misses = 0;
    return true;
}

static struct action look_all_around(struct brain *brain)
{
    int sign = random_below(&brain->random, 2) ? 1 : -1;
    int more = random_below(&brain->random, LEAVE_CHOICES);

    brain->since_mm = 0;
    return (struct action){
        .reason = REASON_LOOK_AROUND,
        .turn_deg = (int16_t)(sign * (WHOLE_TURN_DEG + more)),
        .until_food = true,
    };
}

/* Food that was lost sight of once and again is in a place that it cannot be reached from: each time it goes farther. */
static void miss(struct brain *brain)
{
    brain->since_mm = (uint16_t)(LOOK_EVERY_MM - (LOOK_AGAIN_MM << brain->misses));
    if (brain->misses < MISSES_MAX)
        brain->misses++;
}

static void note_what_is_seen(struct brain *brain, bool look)
{
    if (brain->ate) {
        brain->ate = false;
        brain->misses = 0;
        brain->chasing = false;
        brain->since_mm = LOOK_EVERY_MM;
    }
    if (look)
        brain->since_mm = 0;
    else if (brain->chasing)
        miss(brain);
    brain->chasing = look;
}

static struct action go_on(struct brain *brain, const struct config *config, const struct senses *senses)
{
    note_what_is_seen(brain, senses->look);
    if (brain->since_mm < LOOK_EVERY_MM)
        return listing_step(brain, config, senses);
    brain->repeat_count = 0;
    return look_all_around(brain);
}

/* A step has ended. True: food is within reach. */
static bool step_led_to_food(struct brain *brain, const struct config *config, const struct senses *senses)
{
    brain->awaits = AWAITS_NOTHING;
    brain->since_mm = (uint16_t)(senses->look ? 0 : brain->since_mm + config->value[STEP_MM]);
    brain->ate = senses->look && senses->beacon_mm < config->value[REACH_MM];
    return brain->ate;
}

static struct action choose(struct brain *brain, const struct config *config, const struct senses *senses,
                            uint8_t pattern)
{
    if (brain->awaits == AWAITS_LOOK && step_led_to_food(brain, config, senses))
        return (struct action){.reason = REASON_EAT};
    if (pattern == 0 && brain->awaits != AWAITS_BOREDOM) {
        brain->awaits = AWAITS_NOTHING;
        return go_on(brain, config, senses);
    }
    return listing_next(brain, config, senses, memory_recall(&brain->memory, pattern));
}

struct action searcher_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel);
    struct action action;

    used_cells_learn(brain, senses, CONFIDENCE);
    action = choose(brain, config, senses, pattern);
    used_cells_judge(brain, &action, pattern, PRAISE);
    return action;
}
