/* brain.h: the article's loop, from what is sensed to what is done next. It is asked only when the last action has
 * ended, knows no time and no wheels, and draws random numbers only where the article's listing does. */
#ifndef OCTET_BRAIN_H
#define OCTET_BRAIN_H

#include "firmware/config.h"
#include "firmware/memory.h"
#include "firmware/random.h"

/* One thing to do. */
struct action {
    enum reason reason;
    uint8_t forward_mm;   /* 0 for no step */
    int16_t turn_deg;     /* right positive; 0 for no turn */
};

struct brain {
    struct memory memory;
    struct random random;
    uint8_t repeat_count;    /* remembered turns since the way was last clear; stays at 255 */
    uint8_t awaits;          /* what the action under way leaves to be done when it ends */
    uint8_t tried_pattern;   /* on trial: the pattern in which the turn was tried, */
    uint8_t tried_side;      /* and where to */
    bool frozen;             /* true: it learns no more */
    bool changed;            /* true: the memory is no longer what was last reported */
};

void brain_start(struct brain *brain, uint32_t seed);
        /* Ready for its first decision. What was learned stays. */

struct action brain_next(struct brain *brain, const struct config *config, const struct senses *senses);
        /* The last action has ended with these senses: judges it, and says what to do next. */

#endif
