/* contacts.h: what the space's collisions mean: cones that feel, discs that touch and are pushed out. */
#ifndef OCTET_CONTACTS_H
#define OCTET_CONTACTS_H

#include "host_sim/world/native/world.h"

void contacts_of_cone(struct munk_handler *handler, struct cone *cone);
        /* Makes a handler count what a cone overlaps. */

void contacts_of_discs(struct munk_handler *handler, struct world *world);
        /* Makes a handler note what the bodies touch, and how deep. */

#endif
