#include "lossy_line.h"

#include <string.h>

void lossy_line_put(struct lossy_line *line, const struct frame *frame, unsigned tick)
{
    if (line->count == LINE_ROOM)
        return;   /* lost */
    line->on_the_way[line->count].frame = *frame;
    line->on_the_way[line->count].sent = tick;
    line->count++;
}

struct frame lossy_line_take(struct lossy_line *line, unsigned i)
{
    struct frame frame = line->on_the_way[i].frame;

    line->count--;
    memmove(&line->on_the_way[i], &line->on_the_way[i + 1], (LINE_ROOM - i - 1) * sizeof line->on_the_way[0]);
    memset(&line->on_the_way[line->count], 0, sizeof line->on_the_way[0]);
    return frame;
}

void lossy_line_lose_late(struct lossy_line *line, unsigned tick)
{
    for (unsigned i = line->count; i-- > 0;)
        if (tick - line->on_the_way[i].sent > LINE_LATE_TICKS)
            (void)lossy_line_take(line, i);
}
