/* sharing.h: what other robots have learned, counted second by second: for SHARE, a parameter that is off by default.
 *
 * Each robot has a vote for each pattern: the turn in its cell. A memory of all five sensors has no such cells; the body
 * does not pass it on. */
#ifndef OCTET_SHARING_H
#define OCTET_SHARING_H

#include "firmware/config.h"

struct sharing {
    int8_t votes[CELL_COUNT];   /* for each pattern: robots that turn right less robots that turn left */
    bool whole;                 /* they are those of a whole second */
};

void sharing_start(struct sharing *sharing);
        /* No votes. The second that has begun is not a whole one. */

void sharing_hear(struct sharing *sharing, const struct peer *peer);
        /* Counts half of another robot's memory. Call once a second at most for each half of each robot. */

void sharing_begin_second(struct sharing *sharing, const struct config *config);
        /* Forgets all votes. The second is a whole one if SHARE is on. */

#endif
