/* searcher: as adaptive, but a lesson about one side also teaches the mirror image. It looks for food in another way:
 * it drives straight on, turns once around where it has not looked for a while, and goes straight to the food that it
 * sees. */
#include "firmware/behaviours/behaviour.h"
#include "firmware/pattern.h"

enum {
    CONFIDENCE = 1,
    PRAISE = 1,
    LOOK_EVERY_MM = 1000,   /* distance between two turns around */
    LOOK_AGAIN_MM = 200,    /* after losing sight of food: distance to the next one; twice that if lost again */
    WHOLE_TURN_DEG = 360,
    LEAVE_CHOICES = 60,     /* directions, one degree apart, in which it continues if it saw no food; */
    SOONER_MM = 8           /* per degree it looks this much sooner again, so that it never repeats a loop for ever */
};

enum { FRONT_RIGHT = 1, FRONT = 2, FRONT_LEFT = 4 };   /* of a pattern */

bool searcher_begin(struct brain *brain)
{
    brain->ate = true;   /* so that it looks around first */
    brain->tried_side = SIDE_NOTHING;
    return true;
}

/* Food that it has lost sight of is behind the obstacle that it has turned away from. */
static struct action look_all_around(struct brain *brain)
{
    int more = random_below(&brain->random, LEAVE_CHOICES);
    int turn_deg = WHOLE_TURN_DEG + more;

    brain->since_mm = (uint16_t)(SOONER_MM * more);
    return (struct action){
        .reason = REASON_LOOK_AROUND,
        .turn_deg = (int16_t)(brain->lost && brain->tried_side == SIDE_RIGHT ? -turn_deg : turn_deg),
        .until_food = true,
    };
}

static void note_what_is_seen(struct brain *brain, bool look)
{
    if (brain->ate) {
        brain->ate = false;
        brain->lost = false;
        brain->chasing = false;
        brain->since_mm = LOOK_EVERY_MM;
    }
    if (look) {
        brain->since_mm = 0;
    } else if (brain->chasing) {
        brain->since_mm = (uint16_t)(LOOK_EVERY_MM - (LOOK_AGAIN_MM << brain->lost));
        brain->lost = true;
    }
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

/* The body is symmetric, even if its wires are mixed up: a lesson about an obstacle on one side also holds, mirrored,
 * for the other side. */
static void generalize(struct brain *brain)
{
    uint8_t *cell = brain->memory.cell;
    uint8_t pattern = pattern_of(brain->tried_feel);
    bool right = (pattern & FRONT_RIGHT) != 0, left = (pattern & FRONT_LEFT) != 0;
    uint8_t same = cell[pattern], mirrored = same ^ (SIDE_LEFT | SIDE_RIGHT);

    if (right == left)
        return;
    brain->changed = true;
    cell[FRONT_RIGHT] = right ? same : mirrored;
    cell[FRONT_RIGHT | FRONT] = cell[FRONT_RIGHT];
    cell[FRONT_LEFT] = right ? mirrored : same;
    cell[FRONT_LEFT | FRONT] = cell[FRONT_LEFT];
}

struct action searcher_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel);
    struct action action;

    if (used_cells_learn(brain, senses, CONFIDENCE))
        generalize(brain);
    action = choose(brain, config, senses, pattern);
    used_cells_judge(brain, &action, pattern, PRAISE);
    return action;
}
