/* start.h: chooses the image to start. */
#ifndef OCTET_START_H
#define OCTET_START_H

#include "hal/boot/choice.h"

int start_pick(struct choices *choices);
        /* Returns the slot of the image to start, 0, 1 or SLOT_NONE, after storing the necessary record. choices must
           be open. If nothing was ever chosen, as on a chip flashed by a probe, every signed image counts as
           installed. An image on trial is started only if that start could be counted. */

#endif
