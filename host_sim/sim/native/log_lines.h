/* log_lines.h: the lines of a frame log, as host_sim/client/frame_log.py writes them. */
#ifndef OCTET_LOG_LINES_H
#define OCTET_LOG_LINES_H

#include <stddef.h>

#include "hal/link/link.h"

enum { LOG_STAMP = 26, LOG_LINE_MAX = 48 };   /* characters of a stamp with its channel, of a line with its end */

struct log_lines {
    char *text;   /* without a 0 at its end; null: nothing is logged */
    size_t used;
    char stamp[LOG_STAMP];
};

void log_lines_stamp(struct log_lines *lines, uint64_t time_us);
        /* Sets the time of the lines that follow: less than 10^10 s. */

void log_lines_add(struct log_lines *lines, const struct frame *frame);
        /* Adds a line, unless text is null. The caller ensures that there is room for LOG_LINE_MAX characters. */

#endif
