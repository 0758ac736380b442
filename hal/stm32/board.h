/* board.h: the pins of the board that this is built for, from its CMake file, hal/stm32/boards/NAME.cmake. */
#ifndef OCTET_BOARD_H
#define OCTET_BOARD_H

/* A pin is a number: the port, 0 for A, in the upper four bits, and the pin of the port in the lower four. */
enum { PORT_PINS = 16 };

#include "board_pins.h"   /* BOARD_LED and its like, made by tools/pins */

#endif
