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
    AWAITS_BOREDOM    /* one remembered turn too many was made: about-face */
};

bool listing_trial_helped(const struct brain *brain, const struct senses *senses);
        /* Has a trial just ended, in tried_pattern and to tried_side, with fewer sensors triggered than before? Ask
           before listing_next, which goes on from there. */

struct action listing_next(struct brain *brain, const struct config *config, const struct senses *senses,
                           const struct memory *known);
        /* What the listing does next, if that is all it remembers. */

#endif
