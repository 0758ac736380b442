/* lossy_line.h: one way of a line that loses and delays frames: those on the way, which a test has arrive in any order. */
#ifndef OCTET_LOSSY_LINE_H
#define OCTET_LOSSY_LINE_H

#include "hal/link/link.h"

enum {
    LINE_ROOM = 2,         /* frames on the way at once */
    LINE_LATE_TICKS = 2    /* that a frame can be late */
};

struct lossy_line {
    unsigned count;
    struct {
        struct frame frame;
        unsigned sent;    /* in which tick */
    } on_the_way[LINE_ROOM];
};

void lossy_line_put(struct lossy_line *line, const struct frame *frame, unsigned tick);
        /* Sends a frame in that tick. It is lost if there is no room. */

struct frame lossy_line_take(struct lossy_line *line, unsigned i);
        /* Takes the i-th frame off the line; those after it move up. */

void lossy_line_lose_late(struct lossy_line *line, unsigned tick);
        /* Loses what is too late in that tick. */

#endif
