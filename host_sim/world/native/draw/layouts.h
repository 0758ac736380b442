/* layouts.h: draws the layout of an environment, which its seed and number determine. */
#ifndef OCTET_LAYOUTS_H
#define OCTET_LAYOUTS_H

#include "host_sim/world/native/draw/layout.h"

struct layout_which {
    int64_t seed;
    int64_t number;
    uint32_t robots;   /* at least 1; more of them do not change the rest of the layout */
};

bool layouts_draw(const struct layout_kind *kind, const struct layout_which *which, struct reach *reach,
                  struct layout *out);
        /* Draws the first fair layout: nothing is within sensor reach of a start or of a piece of food, and every
           piece can be reached from each start. out->starts has room for the robots; start_count is the number that
           find room. False if 1000 draws gave no fair layout. reach is working memory for an arena of this size. */

#endif
