/* board.h: the pins of the board that this is built for. Its CMake file, hal/stm32/boards/NAME.cmake, says which. */
#ifndef OCTET_BOARD_H
#define OCTET_BOARD_H

#include <stdbool.h>
#include <stdint.h>

enum { PORT_A, PORT_B, PORT_C };

struct pin {
    uint8_t port;
    uint8_t number;   /* 0..15 */
};

#include "board_pins.h"   /* BOARD_LED and its like, made by tools/pins */

#endif
