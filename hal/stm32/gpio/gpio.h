/* gpio.h: the pins of a chip, once their ports have a clock, and those of the board that this is built for, from its
 * CMake file, hal/stm32/boards/NAME.cmake. */
#ifndef OCTET_GPIO_H
#define OCTET_GPIO_H

#include <stdbool.h>
#include <stdint.h>

/* A pin is a number: the port, 0 for A, in the upper four bits, and the pin of the port in the lower four. */
enum { PORT_PINS = 16 };

#include "board_pins.h"   /* BOARD_LED and its like, made by tools/pins */

enum gpio_mode {
    GPIO_ANALOGUE,
    GPIO_OUTPUT,
    GPIO_PULLED_UP,   /* an input: an open one reads high */
    GPIO_FROM,        /* the input of a peripheral, pulled up */
    GPIO_TO,          /* the output of one */
    GPIO_MODES
};

void gpio_set(uint32_t pin, enum gpio_mode mode, uint32_t function);
        /* function: alternate function number, such as BOARD_CAN_RX_FUNCTION, in chips that select it per pin. */

void gpio_write(uint32_t pin, bool high);
bool gpio_read(uint32_t pin);

void gpio_start(void);
        /* Sets up the pins of the board's LED, CAN and serial port. An open receive pin reads idle. */

#endif
