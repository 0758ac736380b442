/* sharing.h: counts each second what other robots have learned, for the parameter SHARE, which is off by default.
 *
 * Each robot votes for each pattern with the turn in its cell. A memory of all five sensors has no such cells; the
 * body does not pass it on. */
#ifndef OCTET_SHARING_H
#define OCTET_SHARING_H

#include "firmware/config.h"

struct sharing {
    int8_t votes[CELL_COUNT];   /* for each pattern: robots that turn right less robots that turn left */
    bool whole;                 /* they cover a whole second */
};

void sharing_start(struct sharing *sharing);
        /* Resets the votes. The current second does not count as a whole one. */

void sharing_hear(struct sharing *sharing, const struct peer *peer);
        /* Counts half of another robot's memory. Call at most once per second, half and robot. */

void sharing_begin_second(struct sharing *sharing, const struct config *config);
        /* Clears all votes for the next second, which counts as whole if SHARE is on. */

#endif
