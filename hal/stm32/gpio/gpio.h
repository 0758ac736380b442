/* gpio.h: the pins of a chip, numbered as in board.h, once their ports have a clock. */
#ifndef OCTET_GPIO_H
#define OCTET_GPIO_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/stm32/board.h"

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
