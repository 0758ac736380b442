/* draw.h: draws layouts for one robot, fair or not. The order of the draws makes a seed's layout what it is. */
#ifndef OCTET_DRAW_H
#define OCTET_DRAW_H

#include "host_sim/world/native/draw/draws.h"
#include "host_sim/world/native/draw/layout.h"

#define DRAW_PI 3.14159265358979323846

struct pose draw_pose(struct draws *draws, const struct layout_params *params);
        /* A pose anywhere in the arena. */

void draw_food_and_start(struct draws *draws, const struct layout_params *params, struct layout *out);
        /* Adds a piece of food in each of its bands, and a start anywhere. */

void draw_bars(struct draws *draws, const struct layout_params *params, struct layout *out);
void draw_corridors(struct draws *draws, const struct layout_params *params, struct layout *out);
void draw_dead_ends(struct draws *draws, const struct layout_params *params, struct layout *out);
        /* A layout of that style. */

void draw_written(struct draws *draws, const struct layout_kind *kind, struct reach *reach, struct layout *out);
        /* The written layout. If it has no start, draws a fair one. reach is working memory. */

#endif
