/* odometry_backlog.h: estimates how far the wheels will still roll once no more is commanded. Motors follow
 * commands late. A speed loop with gain 1 eventually rolls the commanded distance, so the distance commanded less
 * the distance rolled is still to come, whatever its lag and delay. Any stable linear system with a DC gain of 1
 * in the end rolls the sum of its commands, so no feedback loop can oscillate. A gain other than 1, a dead band,
 * or a limit of speed or acceleration makes part of the estimate wrong. Two bounds correct it: wheels with the
 * same command for 3 ticks have more to come only while they accelerate, since what is missing at a steady speed
 * is never rolled; and wheels have no more to come than a lag of 6 ticks and a delay of 2 can hold at their
 * current speed. Once they stand, nothing is to come after 2 ticks, and the robot commands what is left: with a
 * gain of g, each such round leaves 1 - g of the error. docs/bodies.md has figures. */
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
