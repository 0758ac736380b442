/* odometry_backlog.h: estimates how far the wheels will still roll once no more is commanded. Motors follow commands
 * late. A speed loop with gain 1 eventually rolls the commanded distance, so the distance commanded less the distance
 * rolled is still to come, whatever its lag and delay. docs/bodies.md explains why. */
#ifndef OCTET_ODOMETRY_BACKLOG_H
#define OCTET_ODOMETRY_BACKLOG_H

#include <stdint.h>

enum { BACKLOG_DELAY_TICKS = 2 };   /* a command takes at most this long to arrive */

/* All distances in 0.1 mm, both wheels together. */
struct backlog {
    int16_t counts;    /* still to be rolled, as far as known */
    int16_t rolled;    /* in the last tick */
    int16_t commanded[BACKLOG_DELAY_TICKS];   /* for the last tick and the one before */
    uint8_t same;      /* ticks in a row before the last one with the same command; stays at 255 */
};

void backlog_command(struct backlog *backlog, int32_t counts);
        /* Notes the distance commanded for the next tick. */

void backlog_roll(struct backlog *backlog, int32_t rolled, unsigned ticks);
        /* Notes the distance rolled in this number of ticks. */

int32_t backlog_counts(const struct backlog *backlog);
        /* The distance still to be rolled; 0 if it is only rounding. */

#endif
