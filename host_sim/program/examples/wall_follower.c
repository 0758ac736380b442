/* A robot that follows walls: tools/run --profile host_sim/program/examples/wall_follower.c
 *
 * It searches like searcher: it drives straight on, and looks all around now and then. But once it has lost sight of
 * food, or has looked around in vain several times, it keeps close to what it meets, and so comes around it. */
#include "octet_brain.h"

/* What the last action was, in brain->awaits. */
enum { NOTHING, STEPPED, TRIED, TURNED, TURNED_ENOUGH };

/* What it remembers of its search, in brain->own; 0 after a meal. Distances are in steps. */
enum {
    LOOKS,       /* times that it has looked around in vain */
    CHASING,     /* whether it is driving to food */
    LOST,        /* whether it has lost sight of food */
    TO_LOOK,     /* distance until it looks around */
    TO_FOLLOW,   /* distance for which it turns back to what it met last */
    SEARCH_BYTES
};

enum {
    STEP_LENGTH_MM = 12,
    LOOK_EVERY = 75,       /* distance between two looks around; */
    LOOK_AGAIN = 12,       /* to the next one after it has lost sight of food */
    LEAVE_DEG = 30,        /* after a look it leaves in any direction up to this far aside */
    PATIENCE = 4,          /* looks in vain until it follows walls */
    FOLLOW_FOR = 75,       /* without a new contact, it follows a wall for this distance: */
    FOLLOWING_STEP = 3,    /* after each of these steps, */
    FOLLOWING_DEG = 6      /* it turns back to the wall by this */
};

bool own_begin(struct brain *brain)
{
    (void)brain;
    return true;
}

static enum side opposite(unsigned side)
{
    return side == SIDE_RIGHT ? SIDE_LEFT : SIDE_RIGHT;
}

static bool follows(const struct brain *brain)
{
    return brain->own[LOST] || brain->own[LOOKS] >= PATIENCE;
}

/* The body is symmetric: what helps with an obstacle on one side teaches all four patterns that have a side. */
static void learn(struct brain *brain, uint8_t pattern, enum side side)
{
    static const uint8_t right[] = {1, 3}, left[] = {4, 6};
    bool is_right = pattern == right[0] || pattern == right[1], is_left = pattern == left[0] || pattern == left[1];

    if (is_right == is_left)
        return;
    for (int i = 0; i < 2; i++) {
        memory_learn(&brain->memory, right[i], is_right ? side : opposite(side));
        memory_learn(&brain->memory, left[i], is_left ? side : opposite(side));
    }
    brain->changed = true;
}

static void judge_trial(struct brain *brain, uint8_t pattern)
{
    uint8_t before = pattern_of(brain->tried_feel);

    if (pattern_count(pattern) < pattern_count(before) && !brain->frozen)
        learn(brain, before, (enum side)brain->tried_side);
}

static struct action turn_away(struct brain *brain, const struct config *config, const struct senses *senses)
{
    enum side known = memory_recall(&brain->memory, pattern_of(senses->feel));
    enum side side = known == SIDE_NOTHING ? any_side(brain) : known;

    brain->own[TO_FOLLOW] = FOLLOW_FOR;
    brain->tried_feel = senses->feel;
    brain->tried_side = (uint8_t)side;
    if (known == SIDE_NOTHING) {
        brain->awaits = TRIED;
        return turn(REASON_TRIAL, side, config->value[TRIAL_DEG]);
    }
    brain->repeat_count++;
    brain->awaits = brain->repeat_count < config->value[BOREDOM_LIMIT] ? TURNED : TURNED_ENOUGH;
    return turn(REASON_REMEMBERED, side, config->value[TURN_DEG]);
}

/* What it knew did not help: it may be wrong, and is forgotten. */
static struct action turn_about(struct brain *brain, const struct config *config)
{
    int more = below(brain, config->value[BOREDOM_CHOICES]);

    brain->repeat_count = 0;
    if (!brain->frozen) {
        memory_erase(&brain->memory);
        brain->changed = true;
    }
    return turn(REASON_BOREDOM, SIDE_RIGHT, config->value[BOREDOM_MIN_DEG] + more);
}

/* Food out of sight is behind what it has turned away from: it looks there first. */
static struct action look_around(struct brain *brain)
{
    enum side side = brain->own[LOST] ? opposite(brain->tried_side) : any_side(brain);
    int aside_deg = follows(brain) ? 0 : below(brain, LEAVE_DEG + 1);
    struct action look = turn(REASON_LOOK_AROUND, side, 360 - aside_deg);

    if (brain->own[LOOKS] < PATIENCE)
        brain->own[LOOKS]++;
    brain->own[TO_LOOK] = (uint8_t)(LOOK_EVERY - aside_deg);   /* it never repeats a loop for ever */
    look.until_food = true;
    return look;
}

static uint8_t less(int distance, int steps)
{
    return (uint8_t)(distance > steps ? distance - steps : 0);
}

static struct action drive(struct brain *brain, enum reason reason, int steps)
{
    brain->own[TO_LOOK] = less(brain->own[TO_LOOK], steps);
    brain->own[TO_FOLLOW] = less(brain->own[TO_FOLLOW], steps);
    brain->awaits = STEPPED;
    return step(reason, STEP_LENGTH_MM * steps);
}

static struct action search(struct brain *brain, const struct senses *senses, bool stepped)
{
    bool beside_a_wall = (senses->feel & (FEEL_LEFT | FEEL_RIGHT)) != 0;

    if (brain->own[CHASING]) {
        brain->own[CHASING] = 0;
        brain->own[LOST] = 1;
        brain->own[TO_LOOK] = LOOK_AGAIN;
    }
    if (brain->own[TO_LOOK] == 0)
        return look_around(brain);
    if (!follows(brain) || brain->own[TO_FOLLOW] == 0)
        return drive(brain, REASON_WANDER, 1);
    if (!stepped || beside_a_wall)
        return drive(brain, REASON_WANDER, FOLLOWING_STEP);
    return turn(REASON_LOOK_AROUND, opposite(brain->tried_side), FOLLOWING_DEG);
}

static struct action eat(struct brain *brain)
{
    for (int i = 0; i < SEARCH_BYTES; i++)
        brain->own[i] = 0;
    return (struct action){.reason = REASON_EAT};
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel), last = brain->awaits;

    brain->awaits = NOTHING;
    if (last == TRIED)
        judge_trial(brain, pattern);
    if (last == TURNED_ENOUGH)
        return turn_about(brain, config);
    if (last == STEPPED && senses->look && senses->beacon_mm < config->value[REACH_MM])
        return eat(brain);
    if (pattern != 0)
        return turn_away(brain, config, senses);
    brain->repeat_count = 0;
    if (!senses->look)
        return search(brain, senses, last == STEPPED);
    brain->own[CHASING] = 1;
    brain->own[TO_LOOK] = LOOK_EVERY;
    return drive(brain, REASON_TOWARD_FOOD, 1);
}
