/* brain.h: from what is sensed to what is done next. Called only when the previous action has ended; independent of time
 * and wheels. How it decides is the behaviour's: see behaviours/. */
#ifndef OCTET_BRAIN_H
#define OCTET_BRAIN_H

#include "firmware/config.h"
#include "firmware/memory/memory.h"
#include "firmware/random.h"

/* One thing to do. */
struct action {
    enum reason reason;
    int16_t forward_mm;   /* backward negative; 0 for no step */
    int16_t turn_deg;     /* right positive; 0 for no turn */
    uint8_t rest_ticks;   /* at rest after that, for the sensors to settle */
    bool until_food;      /* the turn ends when food is seen; what was left of it is not made up for */
};

struct brain {
    struct memory memory;
    struct random random;
    uint8_t profile;         /* of the behaviour that decides, an enum profile */
    uint8_t repeat_count;    /* remembered turns since the way was last clear; stays at 255 */
    uint8_t awaits;          /* what the action under way leaves to be done when it ends; 0 for nothing */
    uint8_t tried_feel;      /* what was sensed when the last turn away from something began */
    uint8_t tried_side;      /* where to, on trial or as remembered */
    uint8_t used;            /* used_cells.h: bit p for cell p */
    uint8_t unlearned;       /* likewise: boredom has emptied it since the start */
    bool chasing, ate;       /* searcher: it was going to food; the last step led to it */
    bool lost;               /* searcher: it has lost sight of food since its last meal */
    uint16_t since_mm;       /* searcher: way since it last looked around or saw food */
    bool learns;             /* whether the profile learns; if not, its memory is not stored */
    bool wants_ranges;       /* true: the behaviour decides by range_mm */
    bool frozen;             /* true: it learns no more */
    bool changed;            /* true: the memory differs from what was last reported */
};

bool brain_start(struct brain *brain, uint8_t profile, uint32_t seed);
        /* Ready for its first decision, as that profile decides. What was learned stays, translated to what the profile
           understands. False, and nothing is changed, if there is no such profile. */

bool brain_adopt(struct brain *brain, const uint8_t cells[CELL_COUNT]);
        /* Takes over a memory. If the profile does not understand it, the first one that does is chosen. False, and
           nothing is changed, if the bytes are not a memory. */

extern const uint8_t BRAIN_MEMORY_KINDS[PROFILE_COUNT];
        /* What each profile takes the eight bytes for, an enum memory_kind. */

bool brain_write(struct brain *brain, uint8_t which, uint32_t bytes);
        /* As memory_write, in a memory of the profile's kind. */

bool brain_take_votes(struct brain *brain, const int8_t votes[CELL_COUNT]);
        /* Each cell that is empty, though not from boredom, takes the side that more other robots know for its pattern: right
           where the number is positive, left where it is negative. Only where each pattern has a cell, and the robot
           learns. True if the memory is another one now; brain->changed stays as it is. */

void brain_forget_trial(struct brain *brain);
        /* The action that has ended was not carried out: nothing is learned from it. */

struct action brain_next(struct brain *brain, const struct config *config, const struct senses *senses);
        /* The previous action has ended with these senses: judges it, and says what to do next. */

#endif
