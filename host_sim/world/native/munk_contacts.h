/* munk_contacts.h: what the space's collisions mean: cones that feel, discs that touch and are pushed out. */
#ifndef OCTET_MUNK_CONTACTS_H
#define OCTET_MUNK_CONTACTS_H

#include "host_sim/world/native/munk_space.h"

void munk_contacts_of_cone(struct munk_handler *handler, struct munk_cone *cone);
        /* Makes a handler count what a cone overlaps. */

void munk_contacts_of_discs(struct munk_handler *handler, struct munk_world *space);
        /* Makes a handler note what the bodies touch, and how deep. */

#endif
