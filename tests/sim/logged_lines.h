/* logged_lines.h: the number of lines of a log. */
#ifndef OCTET_LOGGED_LINES_H
#define OCTET_LOGGED_LINES_H

#include "host_sim/sim/native/log_lines.h"

static inline int logged_lines(const struct log_lines *log)
{
    int count = 0;

    for (size_t i = 0; i < log->used; i++)
        count += log->text[i] == '\n';
    return count;
}

#endif
