/* sight.h: the beam that sees food straight ahead. */
#ifndef OCTET_SIGHT_H
#define OCTET_SIGHT_H

#include "host_sim/world/native/world.h"

void sight_look(const struct world *world, struct body *body);
        /* Notes the nearest food in the corridor straight ahead that nothing hides, and its distance: 1 mm or more, or
           0 if there is none. A body in the air sees nothing. */

#endif
