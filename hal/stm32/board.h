/* board.h: the pins of the board that this is built for. Its CMake file, hal/stm32/boards/NAME.cmake, says which. */
#ifndef OCTET_BOARD_H
#define OCTET_BOARD_H

/* A pin is a number: that of its port, from 0 for A, in its upper four bits. */
enum { PORT_PINS = 16 };

#include "board_pins.h"   /* BOARD_LED and its like, made by tools/pins */

#endif
