/* owed.h: how far wheels will still roll when they are told no more. Motors follow their orders late: a speed loop whose gain is
 * 1 rolls in the end what it was told, so that it owes the difference between what it was told and what it has rolled, whatever
 * its lag and its delay. docs/motion.md says why. */
#ifndef OCTET_OWED_H
#define OCTET_OWED_H

#include <stdint.h>

enum { OWED_DELAY_TICKS = 2 };   /* an order takes up to as many until it arrives */

/* All in 0.1 mm of both wheels together. */
struct owed {
    int16_t counts;                   /* as far as is known */
    int16_t rolled;                   /* in the last tick */
    int16_t told[OWED_DELAY_TICKS];   /* for the last tick, and for that before it */
    uint8_t same;                     /* ticks in a row before the last one that were told the same; stays at 255 */
};

void owed_tell(struct owed *owed, int32_t counts);
        /* The wheels are told to roll that far in the next tick. */

void owed_settle(struct owed *owed, int32_t rolled, unsigned ticks);
        /* They have rolled that far in so many ticks. */

int32_t owed_counts(const struct owed *owed);
        /* What they owe; 0 where that is no more than rounding. */

#endif
