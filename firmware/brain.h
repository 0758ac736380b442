/* brain.h: decides the next action from the senses. Called only when the previous action has ended; independent of
 * time and wheels. The behaviour makes the decision: see behaviours/. */
#ifndef OCTET_BRAIN_H
#define OCTET_BRAIN_H

#include "firmware/config.h"
#include "firmware/memory/memory.h"
#include "firmware/random.h"

/* One action. */
struct action {
    enum reason reason;
    int16_t forward_mm;   /* backward negative; 0 for no step */
    int16_t turn_deg;     /* right positive; 0 for no turn */
    uint8_t rest_ticks;   /* rest after that, so that the sensors settle */
    bool until_food;      /* end the turn when food is seen; do not make up for the remainder */
};

enum { TEACHES_NOTHING = 0 };   /* tried_feel: nothing was in the way, or the turn does not count */

struct brain {
    struct memory memory;
    struct random random;
    uint8_t profile;         /* of the behaviour that decides, an enum profile */
    uint8_t repeat_count;    /* remembered turns since the way was last clear; stays at 255 */
    uint8_t awaits;          /* what to do when the current action ends; 0: nothing */
    uint8_t tried_feel;      /* feel when the last turn away from an obstacle began, or TEACHES_NOTHING */
    uint8_t tried_side;      /* and its side, tried or remembered */
    uint8_t used;            /* bit p for cell p */
    uint8_t unlearned;       /* likewise: emptied by boredom since the start */
    bool chasing, ate;       /* searcher: it is going to food; the last step reached it */
    bool lost;               /* searcher: it has lost sight of food since its last meal */
    uint16_t since_mm;       /* searcher: distance since it last looked around or saw food */
    uint8_t own[8];          /* of a behaviour of one's own; all 0 at a start */
    bool learns;             /* whether the profile learns; if not, its memory is not stored */
    bool wants_ranges;       /* true: the behaviour decides by range_mm */
    bool frozen;             /* true: it learns no more */
    bool changed;            /* true: the memory differs from what was last reported */
};

bool brain_start(struct brain *brain, uint8_t profile, uint32_t seed);
        /* Prepares for the first decision with that profile. The memory is kept, converted to the profile's kind.
           False if the robot has no such profile; nothing is changed then. */

bool brain_adopt(struct brain *brain, const uint8_t cells[CELL_COUNT]);
        /* Sets the memory. If its kind is not the profile's, selects the first profile of that kind. False if the
           bytes are not a memory; nothing is changed then. */

extern const uint8_t BRAIN_MEMORY_KINDS[PROFILE_OWN + 1];
        /* The kind of memory that a profile uses, an enum memory_kind. */

bool brain_write(struct brain *brain, uint8_t which, uint32_t bytes);
        /* As memory_write, in a memory of the profile's kind. */

bool brain_take_votes(struct brain *brain, const int8_t votes[CELL_COUNT]);
        /* Each empty cell, unless boredom emptied it, takes the side that more other robots know for its pattern:
           right if its vote is positive, left if negative. Only if each pattern has a cell, and the robot learns.
           True if the memory has changed; brain->changed stays as it is. */

void brain_doubt(struct brain *brain, const struct senses *senses);
        /* The wheels did not obey: nothing is learned from the action that has ended with these senses, and no look
           around follows. */

struct action brain_next(struct brain *brain, const struct config *config, const struct senses *senses);
        /* The previous action has ended with these senses: judges it and returns the next one. */

#endif
