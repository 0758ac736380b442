/* machine.h: the pins of the board that this is built for, and its clocks as they run now. */
#ifndef OCTET_RP2040_MACHINE_H
#define OCTET_RP2040_MACHINE_H

#include "board_pins.h"   /* BOARD_LED and its like, made by tools/pins */
#include "hal/rp2040/clock.h"

struct clocks machine_clocks(void);

#endif
