/* owed.h: estimates how far the wheels will still roll once no more is commanded. Motors follow commands late. A
 * speed loop with gain 1 eventually rolls the commanded distance, so it owes the difference between the distance
 * commanded and the distance rolled, whatever its lag and delay. docs/bodies.md explains why. */
#ifndef OCTET_OWED_H
#define OCTET_OWED_H

#include <stdint.h>

enum { OWED_DELAY_TICKS = 2 };   /* a command takes at most this long to arrive */

/* All distances in 0.1 mm, both wheels together. */
struct owed {
    int16_t counts;                   /* owed, as far as known */
    int16_t rolled;                   /* in the last tick */
    int16_t told[OWED_DELAY_TICKS];   /* commanded for the last tick and the one before */
    uint8_t same;                     /* ticks in a row before the last one with the same command; stays at 255 */
};

void owed_tell(struct owed *owed, int32_t counts);
        /* Notes the distance commanded for the next tick. */

void owed_settle(struct owed *owed, int32_t rolled, unsigned ticks);
        /* Notes the distance rolled in this number of ticks. */

int32_t owed_counts(const struct owed *owed);
        /* The distance owed; 0 if it is only rounding. */

#endif
