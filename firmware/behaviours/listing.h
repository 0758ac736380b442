/* listing.h: the loop of the article's listing, for the behaviours that differ from it only in their knowledge.
 * Random numbers are drawn exactly where the listing draws one. */
#ifndef OCTET_LISTING_H
#define OCTET_LISTING_H

#include "firmware/brain.h"

/* What to do when the current action ends. */
enum awaits {
    AWAITS_NOTHING,
    AWAITS_LOOK,      /* after a step forward: look for food */
    AWAITS_VERDICT,   /* after a trial turn: judge it */
    AWAITS_CHECK,     /* after a remembered turn: nothing in the listing */
    AWAITS_BOREDOM    /* after one remembered turn too many: about-face */
};

bool listing_trial_helped(const struct brain *brain, const struct senses *senses);
        /* Whether a trial has just ended, at tried_feel and to tried_side, with fewer sensors triggered than before.
           Call before listing_next, which begins the next action. */

bool listing_remembered_in_vain(const struct brain *brain, const struct senses *senses);
        /* Whether a remembered turn has just ended, at tried_feel, with no fewer sensors triggered than before. Call
           before listing_next. */

struct action listing_step(struct brain *brain, const struct config *config, const struct senses *senses);
        /* A step forward; sets AWAITS_LOOK. */

struct action listing_next(struct brain *brain, const struct config *config, const struct senses *senses,
                           enum side known);
        /* The listing's next action, given the turn that it remembers for these senses. */

#endif
