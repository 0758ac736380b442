/* plain_view.h: lines of sight in a plain space. */
#ifndef OCTET_PLAIN_VIEW_H
#define OCTET_PLAIN_VIEW_H

#include <stdbool.h>

#include "host_sim/world/native/vector.h"

struct world;
struct body;

bool plain_view_hides(const struct world *world, const struct body *body, struct vector point);
        /* Whether an obstacle or another body is between a body and a point. */

#endif
