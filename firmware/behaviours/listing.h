/* listing.h: the loop of the article's listing, for the behaviours that differ from it only in what they know. Random
 * numbers are drawn where the listing draws one, and nowhere else. */
#ifndef OCTET_LISTING_H
#define OCTET_LISTING_H

#include "firmware/brain.h"

/* What the action under way leaves to be done when it ends. */
enum awaits {
    AWAITS_NOTHING,
    AWAITS_LOOK,      /* a step forward was made: look for food */
    AWAITS_VERDICT,   /* a turn was tried: was it any good? */
    AWAITS_CHECK,     /* a remembered turn was made: nothing that the listing would do */
    AWAITS_BOREDOM    /* one remembered turn too many was made: about-face */
};

bool listing_trial_helped(const struct brain *brain, const struct senses *senses);
        /* Has a trial just ended, at tried_feel and to tried_side, with fewer sensors triggered than before? Ask before
           listing_next, which goes on from there. */

bool listing_remembered_in_vain(const struct brain *brain, const struct senses *senses);
        /* Has a remembered turn just ended, at tried_feel, with as many sensors triggered as before or more? Ask before
           listing_next. */

struct action listing_step(struct brain *brain, const struct config *config, const struct senses *senses);
        /* A step forward, after which AWAITS_LOOK. */

struct action listing_next(struct brain *brain, const struct config *config, const struct senses *senses,
                           enum side known);
        /* What the listing does next, if that is the turn it remembers for these senses. */

#endif
