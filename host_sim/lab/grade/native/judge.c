/* Judges a pupil's behaviour, decision by decision. A shadow, a brain that decides as the exercise requires, receives
 * the same senses. Its random draws are scripted: every outcome is right, and it continues with the pupil's one, so
 * that a pupil may draw in any order. The first decision that no outcome explains is reported. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "host_sim/program/own/guard.h"

#include "firmware/random.h"

static uint8_t scripted_below(struct random *random, uint8_t n);

/* The built-in behaviours, for the shadow. */
#define random_below scripted_below
#define article_begin shadow_article_begin
#define article_next shadow_article_next
#define recheck_begin shadow_recheck_begin
#define recheck_next shadow_recheck_next
#define listing_step shadow_step
#define listing_next shadow_listing_next
#define listing_trial_helped shadow_trial_helped
#define listing_remembered_in_vain shadow_in_vain
#define turn shadow_turn
#include "firmware/behaviours/listing.c"

#include "firmware/behaviours/article.c"
#include "firmware/behaviours/recheck.c"

enum { SAME_MAX = 30, DRAWS_MAX = 4, WORDS_MAX = 120, ENDED = 3, NO_FOOD_MM = 1023, NEVER_BORED = 0 };
enum { ONE_IF = 1, TABLE, COUNT, TRIAL, REMEMBER, BOREDOM, RECHECK };

bool own_begin(struct brain *brain);
struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses);
bool pupil_begin(struct brain *brain);
struct action pupil_next(struct brain *brain, const struct config *config, const struct senses *senses);

static struct brain shadow;
static int exercise;
static unsigned long decisions;
static bool reported;         /* a wrong decision */
static uint8_t drawn[DRAWS_MAX], faces[DRAWS_MAX];
static unsigned draws;

static unsigned same_count;   /* draws of a side in a row with the same outcome, */
static uint8_t same_face;     /* which is this */

/* The first right action, and the range of all right turns. */
struct asked {
    struct action first;
    int least_deg, most_deg;
    bool left, right;
};

static uint8_t scripted_below(struct random *random, uint8_t n)
{
    (void)random;
    faces[draws] = n;
    return drawn[draws++];
}

/* The next outcome of the dice; false if there is none. */
static bool next_outcome(void)
{
    while (draws > 0) {
        draws--;
        if (++drawn[draws] < faces[draws])
            return true;
        drawn[draws] = 0;
    }
    return false;
}

static struct action turn_right(int degrees)
{
    return (struct action){.reason = REASON_PROGRAM, .turn_deg = (int16_t)degrees};
}

static enum side table(uint8_t pattern)
{
    static const uint8_t sides[CELL_COUNT] = {
        SIDE_NOTHING, SIDE_LEFT, SIDE_LEFT, SIDE_LEFT, SIDE_RIGHT, SIDE_LEFT, SIDE_RIGHT, SIDE_LEFT,
    };

    return (enum side)sides[pattern];
}

static struct action ask(struct brain *brain, const struct config *config, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel);
    struct config patient = *config;
    struct senses hungry = *senses;
    int degrees;

    patient.value[BOREDOM_LIMIT] = NEVER_BORED;
    hungry.look = true;                 /* food ahead, and never within reach: no looking around, no eating */
    hungry.beacon_mm = NO_FOOD_MM;
    switch (exercise) {
    case ONE_IF:
        degrees = senses->feel & FEEL_FRONT_RIGHT ? -config->value[TURN_DEG] : 0;
        return degrees ? turn_right(degrees) : shadow_step(brain, config, senses);
    case COUNT:
        degrees = config->value[TURN_DEG] * pattern_count(pattern);
        return degrees ? turn_right(degrees) : shadow_step(brain, config, senses);
    case TABLE:
        return shadow_listing_next(brain, &patient, &hungry, table(pattern));
    case TRIAL:
        return shadow_listing_next(brain, &patient, &hungry, SIDE_NOTHING);
    case REMEMBER:
        return shadow_article_next(brain, &patient, &hungry);
    case BOREDOM:
        return shadow_article_next(brain, config, &hungry);
    default:
        return shadow_recheck_next(brain, config, senses);
    }
}

static bool is_same(const struct action *a, const struct action *b)
{
    return a->forward_mm == b->forward_mm && a->turn_deg == b->turn_deg && a->rest_ticks == b->rest_ticks
        && a->until_food == b->until_food && (a->reason == REASON_EAT) == (b->reason == REASON_EAT);
}

static const char *name_of(enum side side)
{
    return side == SIDE_LEFT ? "left" : side == SIDE_RIGHT ? "right" : "nothing";
}

static void describe(const struct action *action, char words[WORDS_MAX])
{
    if (action->reason == REASON_EAT)
        snprintf(words, WORDS_MAX, "to eat");
    else if (action->turn_deg != 0)
        snprintf(words, WORDS_MAX, "a turn %s by %d degrees", action->turn_deg < 0 ? "left" : "right",
                 abs(action->turn_deg));
    else if (action->forward_mm != 0)
        snprintf(words, WORDS_MAX, "a step of %d mm", action->forward_mm);
    else
        snprintf(words, WORDS_MAX, "to stay");
    if (action->until_food || action->rest_ticks)
        strncat(words, ", with until_food or rest_ticks", WORDS_MAX - strlen(words) - 1);
}

static void describe_asked(const struct asked *asked, char words[WORDS_MAX])
{
    const char *side = asked->left && asked->right ? "to either side" : asked->right ? "right" : "left";

    if (asked->first.turn_deg == 0)
        describe(&asked->first, words);
    else if (asked->least_deg == asked->most_deg)
        snprintf(words, WORDS_MAX, "a turn %s by %d degrees", side, asked->least_deg);
    else
        snprintf(words, WORDS_MAX, "a turn %s by %d to %d degrees", side, asked->least_deg, asked->most_deg);
}

static void widen(struct asked *asked, const struct action *action)
{
    int degrees = abs(action->turn_deg);

    if (!asked->left && !asked->right) {
        asked->first = *action;
        asked->least_deg = degrees;
    }
    asked->least_deg = degrees < asked->least_deg ? degrees : asked->least_deg;
    asked->most_deg = degrees > asked->most_deg ? degrees : asked->most_deg;
    asked->left = asked->left || action->turn_deg < 0;
    asked->right = asked->right || action->turn_deg > 0;
}

/* Prints the start of a line: tick, time, and the shadow's state. The caller prints the rest. */
static void begin_line(const struct brain *before, const struct senses *senses)
{
    uint8_t pattern = pattern_of(senses->feel);
    char when[GUARD_TEXT_MAX];

    long tick = guard_when(when, sizeof when);
    printf("own: %ld %s, decision %lu", tick, when, decisions);
    if (exercise >= REMEMBER && pattern)
        printf(", %s remembered", name_of(memory_recall(&before->memory, pattern)));
    if (exercise >= BOREDOM && before->awaits == AWAITS_BOREDOM)
        printf(", after the last remembered turn before boredom");
    if (exercise == RECHECK && before->awaits == AWAITS_LOOK)
        printf(", after a step");
    printf(": ");
}

/* The process ends only at the next decision, so that the log contains the wrong one. */
static void end_line(void)
{
    printf("\n");
    fflush(stdout);
    reported = true;
}

static void check_memory(const struct brain *pupil, const struct brain *before, const struct senses *senses)
{
    for (unsigned p = 0; p < CELL_COUNT; p++)
        if (pupil->memory.cell[p] != shadow.memory.cell[p]) {
            begin_line(before, senses);
            printf("cell %u was %s, you made it %s; asked is %s", p, name_of((enum side)before->memory.cell[p]),
                   name_of((enum side)pupil->memory.cell[p]), name_of((enum side)shadow.memory.cell[p]));
            if (before->tried_feel)
                printf(", since %u front sensors are triggered after the turn %s, and %u before it",
                       (unsigned)pattern_count(pattern_of(senses->feel)), name_of((enum side)before->tried_side),
                       (unsigned)pattern_count(pattern_of(before->tried_feel)));
            end_line();
            return;
        }
}

/* Every outcome of a draw is right, but not the same one more than SAME_MAX times in a row. */
static void check_dice(const struct brain *before, const struct senses *senses)
{
    if (draws == 0 || faces[0] != 2)
        return;
    same_count = drawn[0] == same_face ? same_count + 1 : 1;
    same_face = drawn[0];
    if (same_count <= SAME_MAX)
        return;
    begin_line(before, senses);
    printf("you have chosen the same side %u times in a row; asked is a side that is drawn", same_count);
    end_line();
}

static void check_action(const struct action *did, const struct brain *before, const struct config *config,
                         const struct senses *senses)
{
    struct asked asked = {.least_deg = 0};
    char chosen[WORDS_MAX], right[WORDS_MAX];
    struct action action;

    memset(drawn, 0, sizeof drawn);
    do {
        draws = 0;
        shadow = *before;
        action = ask(&shadow, config, senses);
        if (is_same(did, &action)) {
            check_dice(before, senses);
            return;
        }
        widen(&asked, &action);
    } while (next_outcome());
    describe(did, chosen);
    describe_asked(&asked, right);
    begin_line(before, senses);
    printf("you chose %s; asked is %s", chosen, right);
    end_line();
}

bool own_begin(struct brain *brain)
{
    exercise = atoi(getenv("OCTET_EXERCISE"));
    decisions = 0;
    shadow = *brain;
    return pupil_begin(brain);
}

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    struct brain before;
    struct action did;

    if (reported)
        _exit(ENDED);
    did = pupil_next(brain, config, senses);
    decisions++;
    shadow.frozen = brain->frozen;
    before = shadow;
    check_action(&did, &before, config, senses);
    if (!reported && exercise >= REMEMBER)
        check_memory(brain, &before, senses);
    return did;
}
