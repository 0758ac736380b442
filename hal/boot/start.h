/* start.h: which image a start goes to. */
#ifndef OCTET_START_H
#define OCTET_START_H

#include "hal/boot/choice.h"

int start_pick(struct choices *choices);
        /* The slot of the image to be started, with all stored that has to be before it is: 0, 1 or SLOT_NONE. choices is
           open. Where nothing was ever chosen, as on a chip that was flashed by a probe, whatever is signed is taken for
           installed. An image on trial is not started unless that could be counted. */

#endif
