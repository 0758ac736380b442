/* sight.h: the beam that sees food straight ahead. */
#ifndef OCTET_SIGHT_H
#define OCTET_SIGHT_H

#include "host_sim/world/native/world.h"

void sight_look(const struct world *world, struct body *body);
        /* Finds the nearest visible food in the beam straight ahead, and its distance: 1 mm or more, or 0 if there is
           none. A lifted body sees nothing. */

#endif
